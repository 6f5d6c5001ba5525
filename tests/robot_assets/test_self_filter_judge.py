"""The self filter, with the whole posed body as one mesh and every ray cast in it as the judge."""

from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest
import trimesh
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from robot_assets import RayCaster, Robot, SelfFilter, SensorModel, load_rig, load_robot
from robot_assets.robot import Transform

MARGIN = 0.03
RIG = load_rig()
RAYS = np.stack([RIG.model.directions] * (len(RIG.sensors) + 4))
RAYS[0, 4:], RAYS[0, :, 4:] = np.nan, np.nan  # a sensor of 4 x 4 zones
RAYS[1] = SensorModel(field_of_view=np.radians(150), distance="radial").directions
CORNERS = [(0.0, 0.0), (-0.4, -0.4), (-0.4, 0.4), (0.4, -0.4), (0.4, 0.4)]
Frame = tuple[np.ndarray, np.ndarray, dict[str, Transform]]


@pytest.fixture(scope="module")
def panda() -> Robot:
    return load_robot()


def frame(robot: Robot, seed: int) -> Frame:
    """Readings, sensor poses and link poses: the rig's sensors, and four anywhere around."""
    rng = np.random.default_rng(seed)
    joints = {name: rng.uniform(*robot.joint_limits[name]) for name in robot.joint_names}
    T_base = placed(rng, 2.0)
    poses = {link: T_base @ T for link, T in robot.link_poses(joints).items()}
    T = np.stack(
        [
            *(poses[s.link] @ s.T_link_sensor for s in RIG.sensors),
            *(T_base @ placed(rng, 1.0) for _ in range(4)),
        ]
    )
    T[rng.random(len(T)) < 0.05] = np.nan
    del poses[rng.choice(sorted(robot.collision_meshes))]
    ranges = rng.uniform(0.0, rng.choice([0.3, 1.0, 4.0]), RAYS.shape[:3])
    ranges[rng.random(ranges.shape) < 0.1] = np.nan
    valid = np.isfinite(ranges) & np.isfinite(RAYS[..., 0]) & np.isfinite(T[:, 0, :1, None])
    return np.where(valid, ranges, np.nan), T, poses


def placed(rng: np.random.Generator, farthest: float) -> Transform:
    T = np.eye(4)
    T[:3, :3] = Rotation.random(rng=rng).as_matrix()
    T[:3, 3] = rng.uniform(-farthest, farthest, 3)
    return T


def judged(robot: Robot, ranges: np.ndarray, T: np.ndarray, poses: dict[str, Transform]):
    body = trimesh.util.concatenate(
        [
            m.copy().apply_transform(poses[k])
            for k, m in robot.collision_meshes.items()
            if k in poses
        ]
    )
    caster = RayCaster(body)  # type: ignore[arg-type]
    shows = np.zeros(ranges.shape, bool)
    read = np.isfinite(ranges)
    origins = np.broadcast_to(T[:, None, None, :3, 3], RAYS.shape)[read]
    down, right = RAYS[:, 1:2, :1] - RAYS[:, :1, :1], RAYS[:, :1, 1:2] - RAYS[:, :1, :1]
    for row, column in CORNERS:
        rays = np.einsum("sij,srcj->srci", T[:, :3, :3], RAYS + row * down + column * right)[read]
        lengths = np.linalg.norm(rays, axis=1)
        distance, _ = caster.cast(origins, rays / lengths[:, None])
        shows[read] |= ranges[read] * lengths >= distance - MARGIN
    return shows


@settings(max_examples=40)
@given(st.integers(0, 10**6))
def test_readings_of_the_robot_are_those_of_its_body_as_one_mesh(panda, seed):
    ranges, T, poses = frame(panda, seed)
    shows = SelfFilter(panda, RAYS, MARGIN).shows_robot(ranges, T, poses)
    assert (shows == judged(panda, ranges, T, poses)).all()


def test_frames_in_several_threads_are_as_those_one_by_one(panda):
    frames = [frame(panda, seed) for seed in range(40)]
    alone = SelfFilter(panda, RAYS)
    expected = [alone.shows_robot(*each) for each in frames]
    shared = SelfFilter(panda, RAYS)
    with ThreadPoolExecutor(4) as threads:
        found = list(threads.map(lambda each: shared.shows_robot(*each), frames))
    np.testing.assert_array_equal(found, expected)
    assert 0.01 < np.mean(expected) < 0.5, "some readings are of the robot, and most are not"
