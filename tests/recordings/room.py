"""A room with 24 sensors of which every number is known, as others would record it."""

from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

from tests.recordings.foreign import (
    FOCAL,
    ForeignFile,
    camera_info,
    image,
    point_cloud,
    transforms,
    twist,
)

PERIOD = 66_666_667
START = 1_700_000_000_123_456_789
NEAR, WALL = 1.2, 1.9
"""Distances in metres of the moving board at the first frame, and of the walls."""


@dataclass(frozen=True)
class Room:
    """Ground truth of a recording written by `write_room`.

    Attributes:
        path: the recording.
        stamps: (K,) nanoseconds.
        points: for each frame (N, 3) metres in the world, of all sensors in order.
        velocity: (3,) m/s of the board that half of the sensors look at, once it moves.
        on_board: for each frame (N,) whether a point is on the board.
        rests: how many frames the board rests at first.
    """

    path: Path
    stamps: NDArray[np.int64]
    points: list[NDArray[np.float64]]
    velocity: NDArray[np.float64]
    on_board: list[NDArray[np.bool_]]
    rests: int


def write_room(
    path: Path, frames: int = 14, seed: int = 0, *, rests: int = 0, tells_points: bool = False
) -> Room:
    """24 sensors in a ring that slides along x; a board comes nearer from +y, walls stand still.

    Args:
        path: of the file.
        frames: how many there are.
        seed: of the noise.
        rests: how many frames the board rests at first.
        tells_points: whether the truth of every point is recorded.
    """
    rng = np.random.default_rng(seed)
    velocity = np.array([0.0, -0.2, 0.0])
    stamps = START + np.arange(frames) * PERIOD + rng.integers(-2_000_000, 2_000_000, frames)
    file = ForeignFile()
    clouds: list[NDArray[np.float64]] = []
    on_board: list[NDArray[np.bool_]] = []
    for s in range(24):
        info = camera_info(int(stamps[0]), f"skin_{s}")
        file.add(f"/skin/s{s}/camera_info", "sensor_msgs/msg/CameraInfo", info, int(stamps[0]))
    for k, stamp in enumerate(stamps.tolist()):
        seconds = (stamp - int(stamps[0])) * 1e-9
        poses = [_sensor_pose(s, 0.05 * seconds) for s in range(24)]
        tf = transforms(stamp, [("world", f"skin_{s}", T) for s, T in enumerate(poses)])
        file.add("/tf", "tf2_msgs/msg/TFMessage", tf, stamp + 1_000)
        moves = k >= rests
        board = NEAR + velocity[1] * max(0.0, stamp - stamps.tolist()[min(rests, k)]) * 1e-9
        cloud: list[NDArray[np.float64]] = []
        boards: list[NDArray[np.bool_]] = []
        for s, T in enumerate(poses):
            millimetres, hits = _readings(T, board, rng)
            content = image(stamp, f"skin_{s}", millimetres, "16UC1")
            file.add(f"/skin/s{s}/depth", "sensor_msgs/msg/Image", content, stamp + 2_000)
            cloud.append(_points(T, millimetres))
            boards.append(hits[millimetres > 0])
        clouds.append(np.vstack(cloud))
        on_board.append(np.concatenate(boards))
        truth = twist(stamp, "world", velocity * moves)
        file.add("/target/velocity", "geometry_msgs/msg/TwistStamped", truth, stamp + 3_000)
        if tells_points:
            velocities = np.where(on_board[-1][:, None], velocity * moves, 0.0)
            told = point_cloud(stamp, "world", clouds[-1], velocities, on_board[-1])
            file.add("/truth/points", "sensor_msgs/msg/PointCloud2", told, stamp + 4_000)
    return Room(file.write(path), stamps, clouds, velocity, on_board, rests)


def _sensor_pose(s: int, slide: float) -> NDArray[np.float64]:
    """Three rings of eight, looking outwards; optical frame x right, y down, z forward."""
    ring, angle = divmod(s, 8)
    T = np.eye(4)
    T[:3, :3] = (
        Rotation.from_euler("z", angle * np.pi / 4) * Rotation.from_euler("x", -np.pi / 2)
    ).as_matrix()
    T[:3, 3] = [slide, 0.0, 0.4 + 0.25 * ring]
    T[:3, 3] += 0.08 * T[:3, 2]
    return T


def _readings(
    T: NDArray[np.float64], board: float, rng: np.random.Generator
) -> tuple[NDArray[np.uint16], NDArray[np.bool_]]:
    """Perpendicular distances in mm of a board at y = `board`, |x| < 0.25, and of square walls.

    Beside them, whether they are the board's.
    """
    rays = _rays() @ T[:3, :3].T
    origin = T[:3, 3]
    with np.errstate(divide="ignore", invalid="ignore"):
        to_board = (board - origin[1]) / rays[..., 1]
        hits = (to_board > 0) & (np.abs(origin[0] + to_board * rays[..., 0]) < 0.25)
        walls = [
            (side * WALL - origin[axis]) / rays[..., axis] for axis in (0, 1) for side in (-1, 1)
        ]
    before_walls = np.where(hits, to_board, np.inf)
    depth = before_walls
    for wall in walls:
        depth = np.fmin(depth, np.where(wall > 0, wall, np.inf))
    noisy = depth * (1 + 0.005 * rng.normal(size=depth.shape))
    noisy[rng.uniform(size=depth.shape) < 0.05] = 0.0
    return np.round(noisy * 1000).astype("<u2"), depth == before_walls


def _points(T: NDArray[np.float64], millimetres: NDArray[np.uint16]) -> NDArray[np.float64]:
    seen = _rays() * (millimetres[..., None] / 1000.0)
    return (seen @ T[:3, :3].T + T[:3, 3])[millimetres > 0]


def _rays() -> NDArray[np.float64]:
    v, u = np.mgrid[0:8, 0:8]
    return np.stack([(u - 3.5) / FOCAL, (v - 3.5) / FOCAL, np.ones((8, 8))], axis=-1)
