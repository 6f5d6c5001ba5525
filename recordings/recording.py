"""Recording: clouds of its frames in a fixed frame, robot poses, and truth."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path
from types import TracebackType

import numpy as np
from numpy.typing import NDArray

from recordings.cloud import Cloud, Reading, read_only
from recordings.decoding import Decoder
from recordings.frame import Provenance
from recordings.frame_readings import FrameReadings
from recordings.frame_table import FrameTable
from recordings.grids import common_grid, padded
from recordings.mcap_file import McapFile
from recordings.object_meshes import ObjectMesh, TrueObjects
from recordings.point_truth import PointTruths
from recordings.robot_poses import RobotPoses
from recordings.sensor_poses import SensorPoses
from recordings.sensors import DepthStream, RecordedSensor
from recordings.truth import ObjectTruth, PairTruth, RigidTruth
from robot_assets import Rig, Robot, SelfFilter, Transform
from robot_assets.printable import printable

_CACHED_FRAMES, _LEAST_CACHED = 512, 16
_CACHED_ZONES = 2**19  # of all cached frames, each some 50 bytes
DEFAULT_MAX_RANGE = 4.0


@dataclass(frozen=True)
class Parts:
    """Parts of a `Recording`, made by `open_recording`."""

    file: McapFile
    decoder: Decoder
    frames: FrameTable
    streams: Sequence[DepthStream]
    sensor_poses: SensorPoses
    robot: RobotPoses | None
    truth: ObjectTruth | None
    point_truths: PointTruths | None
    objects: TrueObjects
    fixed_frame: str
    truth_frame: str | None
    provenance: Provenance | None
    rig: Rig | None
    warnings: tuple[str, ...]


class Recording:
    """Opened recording; immutable and thread-safe.

    Frames are decoded on first access, and the last few hundred are cached.

    Attributes:
        path: the file.
        name: the file's name without its ending.
        stamps: (K,) seconds, strictly increasing.
        sensors: in the order of `Cloud.sensor`.
        fixed_frame: frame of clouds and truth.
        truth_frame: frame whose rigid motion is the truth, None for the recorded twist or pose.
        robot: None where there is none.
        provenance: None for files of other writers.
        object_meshes: {frame: surface} of a simulation's moving objects, empty in other files.
        rig: of the simulation, None where the file does not hold it.
        duplicates: frames dropped because a later one has the same stamp.
    """

    def __init__(self, parts: Parts) -> None:
        self._parts = parts
        self.path: Path = parts.file.path
        self.name = parts.file.path.stem
        self.stamps = parts.frames.stamps.astype(np.float64) * 1e-9
        self.sensors: tuple[RecordedSensor, ...] = tuple(s.sensor for s in parts.streams)
        self.fixed_frame = parts.fixed_frame
        self.truth_frame = parts.truth_frame
        self.robot: Robot | None = parts.robot.robot if parts.robot else None
        self.provenance = parts.provenance
        self.rig: Rig | None = parts.rig
        self.object_meshes: Mapping[str, ObjectMesh] = parts.objects.meshes
        self.duplicates = parts.frames.duplicates
        self._grid = common_grid([sensor.grid for sensor in self.sensors])
        self._readings = FrameReadings(parts.streams, parts.decoder, self._grid)
        # The point in the optical frame is the reading times its ray.
        self._rays = np.stack([padded(s.directions, self._grid, np.nan) for s in self.sensors])
        robot = self.robot
        self._self_filter = SelfFilter(robot, self._rays) if robot else None
        with np.errstate(over="ignore", invalid="ignore"):  # intrinsics may be any numbers
            lengths = np.linalg.norm(self._rays, axis=-1, keepdims=True)
            self._directions = read_only(self._rays / lengths)
        kept = _CACHED_ZONES // self._rays[..., 0].size
        kept = min(max(kept, _LEAST_CACHED), _CACHED_FRAMES)
        self._reading = lru_cache(maxsize=kept)(self._read)

    @property
    def simulated(self) -> bool:
        """Whether the readings were simulated."""
        return self.provenance is not None and self.provenance.simulated

    @property
    def warnings(self) -> tuple[str, ...]:
        """Messages about unusable parts; reading further frames may add some."""
        robot = self.robot.mesh_warnings if self.robot else []
        left_out = self._parts.decoder.left_out.sentences()
        return tuple(map(printable, (*self._parts.warnings, *robot, *left_out)))

    @property
    def has_truth(self) -> bool:
        """Whether the motion of the moving object is known at some frames."""
        return self._parts.truth is not None

    @property
    def unplaced(self) -> NDArray[np.bool_]:
        """(K,) whether a frame lies outside the known poses of every sensor: its cloud is empty."""
        return self._parts.sensor_poses.unplaced

    def __len__(self) -> int:
        return len(self.stamps)

    def __enter__(self) -> "Recording":
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        traceback: TracebackType | None,
    ) -> None:
        self.close()

    def close(self) -> None:
        """Close the file; only cached frames can still be read."""
        self._parts.file.close()

    def cloud(self, k: int, max_range: float = DEFAULT_MAX_RANGE) -> Cloud:
        """Cloud of frame `k`.

        Args:
            k: index of the frame, from 0.
            max_range: metres along the zone's ray.

        Raises:
            IndexError: there is no such frame.
            RecordingError: the file is broken there.
        """
        return self._reading(self._checked(k)).cloud(max_range)

    def T_fixed_sensor(self, k: int) -> NDArray[np.float64]:  # noqa: N802 (a transformation)
        """Poses (S, 4, 4) of the sensors at frame `k`, NaN where unknown."""
        return self._parts.sensor_poses.at(self._checked(k))

    def latest_messages(self, k: int) -> NDArray[np.float64]:
        """Header stamps (S,) in seconds of each sensor's last message up to frame `k`.

        One before `stamps[k]` is of an earlier frame: the sensor has no message of this one. NaN
        where it has none yet.
        """
        frames = self._parts.frames.message[: self._checked(k) + 1]
        latest = np.full(len(self.sensors), np.nan)
        for s, stream in enumerate(self._parts.streams):
            index = frames[-1, s]
            if index < 0:
                earlier = np.flatnonzero(frames[:, s] >= 0)
                if len(earlier) == 0:
                    continue
                index = frames[earlier[-1], s]
            stamps = self._parts.decoder.header_stamps(stream.topic.channel)
            latest[s] = stamps[index].astype(np.float64) * 1e-9
        return latest

    def joint_positions(self, k: int) -> dict[str, float]:
        """{joint: rad or m} at frame `k`; empty without a robot or outside its recorded joints."""
        robot = self._parts.robot
        return robot.joint_positions(self._checked(k)) if robot else {}

    def link_poses(self, k: int) -> dict[str, Transform]:
        """{link: T_fixed_link (4, 4)} at frame `k` of the links whose pose is known."""
        robot = self._parts.robot
        return dict(robot.link_poses(self._checked(k))) if robot else {}

    def object_poses(self, k: int) -> dict[str, Transform]:
        """{frame of `object_meshes`: T_fixed_object (4, 4)} at frame `k`, NaN where unknown."""
        return self._parts.objects.poses(self._checked(k))

    def truth(self, k: int) -> NDArray[np.float64] | None:
        """Velocity (3,) m/s of the moving object in the fixed frame, None where unknown.

        For a rotating object or a truth frame it is the velocity of its origin.
        """
        k = self._checked(k)
        return self._parts.truth.at(k) if self._parts.truth else None

    def point_truth(
        self, k: int, max_range: float = DEFAULT_MAX_RANGE
    ) -> NDArray[np.float64] | None:
        """Velocity (N, 3) m/s of each point of `cloud(k, max_range)`, zero where static.

        With a truth frame, or where the only truth is a pose, every point is assumed to move with
        it. None where the recording has no such truth; NaN for points without.
        """
        cloud = self.cloud(k, max_range)
        if self._everything_moves and isinstance(self._parts.truth, RigidTruth):
            return self._parts.truth.rates(k, cloud.points)
        found = self._parts.point_truths.at(k, cloud) if self._parts.point_truths else None
        return found[0] if found else None

    def pair_truth(
        self, source_k: int, target_k: int, max_range: float = DEFAULT_MAX_RANGE
    ) -> PairTruth | None:
        """The truth over a pair for each point of `cloud(source_k, max_range)`, None if unknown."""
        cloud = self.cloud(source_k, max_range)
        truth = self._parts.truth
        velocity = truth.over(source_k, self._checked(target_k), cloud.points) if truth else None
        if velocity is None:
            return None
        velocity = read_only(velocity)
        if self._everything_moves:
            return PairTruth(velocity, velocity)
        own = self._parts.point_truths
        points = own.over(source_k, target_k, cloud) if own else None
        return PairTruth(velocity, None if points is None else read_only(points))

    @property
    def _everything_moves(self) -> bool:
        """Whether every point is assumed to move with the truth frame or the only recorded pose."""
        parts = self._parts
        rigid = isinstance(parts.truth, RigidTruth)
        return rigid and (parts.truth_frame is not None or parts.point_truths is None)

    def _checked(self, k: int) -> int:
        if not 0 <= k < len(self):
            raise IndexError(f"{self.name} has the frames 0 to {len(self) - 1}, and not {k}.")
        return int(k)

    def _read(self, k: int) -> Reading:
        parts = self._parts
        values, status = self._readings.at(parts.frames.message[k])
        T_fixed_sensor = parts.sensor_poses.at(k)
        in_sensor = values[..., None] * self._rays
        R, t = T_fixed_sensor[:, :3, :3], T_fixed_sensor[:, :3, 3]
        points = np.einsum("sij,srcj->srci", R, in_sensor) + t[:, None, None, :]
        visible = np.isfinite(points).all(axis=-1)
        link_poses = parts.robot.link_poses(k) if parts.robot else {}
        if self._self_filter and link_poses:
            valid = np.where(visible, values, np.nan)
            visible &= ~self._self_filter.shows_robot(valid, T_fixed_sensor, link_poses)
        return Reading(
            stamp=float(self.stamps[k]),
            directions=self._directions,
            ranges=read_only(np.ascontiguousarray(in_sensor[..., 2])),
            status=None if status is None else read_only(status),
            T_fixed_sensor=read_only(T_fixed_sensor),
            points=read_only(points),
            distance=read_only(np.linalg.norm(in_sensor, axis=-1)),
            visible=read_only(visible),
        )
