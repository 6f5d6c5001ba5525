"""Truth of every point, read from a recording."""

from collections.abc import Callable
from functools import lru_cache
from itertools import pairwise
from typing import Any

import numpy as np
from numpy.typing import NDArray

from recordings.cloud import Cloud
from recordings.contents import TRUTH_FIELDS, Topic
from recordings.decoding import Decoder
from recordings.errors import MisfitError
from recordings.floats import as_doubles
from recordings.nearby import Column
from recordings.point_clouds import fields_of
from recordings.tracks import FARTHEST, Stamps
from recordings.transforms import Transform, inverse
from recordings.twists import Twist, fitted_twist

_REAL = ("x", "y", "z", "vx", "vy", "vz")
_NEAREST = 0.2  # metres: noise of a few percent of some metres, well below the size of an object
_CACHED_FRAMES, _CACHED_OBJECTS, _CACHED_STEPS = 64, 256, 1024


class _FrameTruth:
    """Truth at one frame: its table, and positions (N, 3) of it."""

    def __init__(self, table: dict[str, NDArray[Any]]) -> None:
        self.table = table
        self.points = np.stack([table[axis] for axis in ("x", "y", "z")], axis=-1)
        # A further row, which is also row -1, is that of points without truth.
        velocity = np.stack([table[axis] for axis in ("vx", "vy", "vz")], axis=-1)
        self._velocity = np.concatenate([velocity, np.full((1, 3), np.nan)])
        self._object = np.concatenate([table["object"], [-1]])
        self._twists: dict[int, Twist | None] = {}

    def at(self, row: NDArray[np.int64]) -> tuple[NDArray[np.float64], NDArray[np.int64]]:
        """Velocity (N, 3) and object (N,) of rows of the table, NaN and -1 for row -1."""
        return self._velocity.take(row, axis=0), self._object.take(row)

    def twist(self, number: int) -> Twist | None:
        """Twist of an object, None where it has no points."""
        if number not in self._twists:
            # Rows are taken by their numbers, which is four times as fast as by booleans.
            mine = np.flatnonzero(self.table["object"] == number)
            points, velocity = self.points.take(mine, axis=0), self._velocity.take(mine, axis=0)
            self._twists[number] = fitted_twist(points, velocity) if len(mine) else None
        return self._twists[number]


class PointTruths:
    """Truth of points in the recording: position, velocity and object of every reading.

    Args:
        topic: PointCloud2 with x, y, z, vx, vy, vz, object, and, in our files, sensor and zone.
        decoder: of the file.
        stamps: (K,) nanoseconds of the frames.
        tolerance: largest difference between a message's stamp and a frame's, nanoseconds.
        poses: gives the poses (K, 4, 4) of an object, by its number, at the frames, NaN where
            unknown, or a `Column` of them; None for one without.
    """

    def __init__(
        self,
        topic: Topic,
        decoder: Decoder,
        stamps: Stamps,
        tolerance: float,
        poses: Callable[[int], NDArray[np.float64] | Column | None],
    ) -> None:
        self._topic, self._decoder = topic, decoder
        self._poses = lru_cache(maxsize=_CACHED_OBJECTS)(poses)
        self._message = _nearest(decoder.header_stamps(topic.channel), stamps, tolerance)
        self._seconds = (stamps - stamps[0]) * 1e-9
        self._frame = lru_cache(maxsize=_CACHED_FRAMES)(self._read)
        self._step = lru_cache(maxsize=_CACHED_STEPS)(self._step_of)

    def at(self, k: int, cloud: Cloud) -> tuple[NDArray[np.float64], NDArray[np.int64]] | None:
        """Velocity (N, 3) m/s and object (N,) of each point of a frame's cloud.

        Velocities are NaN and objects -1 for points without truth; None for frames without.
        """
        frame = self._frame(k)
        return None if frame is None else frame.at(_rows(frame.table, cloud))

    def over(self, source_k: int, target_k: int, cloud: Cloud) -> NDArray[np.float64] | None:
        """Mean velocity (N, 3) m/s of each point of the source cloud until the target frame.

        A point moves rigidly with its object, by the object's recorded poses. Without poses a twist
        is fitted to the velocities of the object's points at every frame and integrated: exact
        while the motion is constant; with too few points for a rotation it is their mean velocity.
        A point's deviation from the twist at the source frame is kept throughout.
        """
        frame = self._frame(source_k)
        if frame is None:
            return None
        row = _rows(frame.table, cloud)
        velocity, objects = frame.at(row)
        seconds = self._seconds[target_k] - self._seconds[source_k]
        for number in np.unique(objects[objects >= 0]).tolist():
            motion = self._pose_change(number, source_k, target_k)
            if motion is None and self._rests(number, source_k, target_k):
                continue  # as the room does, with most points of a cloud
            mine = objects == number
            points = frame.points[row[mine]]
            if motion is not None:
                deviation = np.zeros(3)
            else:
                motion = self._integrated(number, source_k, target_k)
                twist = frame.twist(number)
                assert twist is not None  # some of its points are in the cloud
                deviation = velocity[mine] - twist.velocity(points)
            moved = points @ motion[:3, :3].T + motion[:3, 3]
            velocity[mine] = (moved - points) / seconds + deviation
        return velocity

    def _pose_change(self, number: int, source_k: int, target_k: int) -> Transform | None:
        """Motion (4, 4) of an object from the source to the target frame, None where unknown."""
        poses = self._poses(number)
        if poses is None:
            return None
        motion = poses[target_k] @ inverse(poses[source_k])
        return motion if np.isfinite(motion).all() else None

    def _rests(self, number: int, source_k: int, target_k: int) -> bool:
        """Whether an object is at rest in all frames in which it is seen."""
        twists = (self._twist(number, k) for k in range(source_k, target_k + 1))
        return all(twist is None or twist.rests for twist in twists)

    def _integrated(self, number: int, source_k: int, target_k: int) -> Transform:
        """Motion (4, 4) by the twists of the frames in which the object is seen."""
        seen = [k for k in range(source_k, target_k + 1) if self._twist(number, k)]
        motion = np.eye(4)
        for before, after in pairwise(seen):
            motion = self._step(number, before, after) @ motion
        if seen[-1] < target_k:  # the last twist holds until the target frame
            last = self._twist(number, seen[-1])
            assert last is not None
            motion = last.motion(self._seconds[target_k] - self._seconds[seen[-1]]) @ motion
        return motion

    def _step_of(self, number: int, before: int, after: int) -> Transform:
        """Motion (4, 4) of an object between two frames in which it is seen."""
        first, second = self._twist(number, before), self._twist(number, after)
        assert first is not None
        assert second is not None
        return first.mean_with(second).motion(self._seconds[after] - self._seconds[before])

    def _twist(self, number: int, k: int) -> Twist | None:
        """Twist of an object at a frame, None where it is not seen."""
        frame = self._frame(k)
        return frame.twist(number) if frame else None

    def _read(self, k: int) -> _FrameTruth | None:
        index = int(self._message[k])
        if index < 0:
            return None
        cloud = self._decoder.readable(self._topic.channel, index)
        if cloud is None:
            return None
        try:
            table = truth_fields(cloud)
            if missing := sorted(TRUTH_FIELDS - set(table)):
                raise MisfitError(f"it lacks {', '.join(missing)}")
        except MisfitError as error:
            self._decoder.leave_out(self._topic.channel, index, str(error))
            return None
        return _FrameTruth(table)


def truth_fields(cloud: Any) -> dict[str, NDArray[Any]]:  # noqa: ANN401 (sensor_msgs/PointCloud2)
    """Fields of a cloud with the truth of points, (N,) each: floats, and numbers as integers.

    Floats beyond `FARTHEST` are NaN; numbers that are none are -1.

    Raises:
        MisfitError: the cloud has too few bytes for its size, or fields that do not fit.
    """
    table: dict[str, NDArray[Any]] = {}
    for name, field in fields_of(cloud).items():
        values = as_doubles(field)
        values[~(np.abs(values) <= FARTHEST)] = np.nan if name in _REAL else -1.0
        table[name] = values if name in _REAL else values.astype(np.int64)
    return table


def _nearest(messages: Stamps, stamps: Stamps, tolerance: float) -> NDArray[np.int64]:
    """Index of the nearest message of each stamp, -1 where none is within the tolerance."""
    order = np.argsort(messages, kind="stable")
    ordered = messages[order]
    after = np.clip(np.searchsorted(ordered, stamps), 0, len(ordered) - 1)
    before = np.clip(after - 1, 0, None)
    nearest = np.where(
        np.abs(ordered[before] - stamps) < np.abs(ordered[after] - stamps), before, after
    )
    near = np.abs(ordered[nearest] - stamps) <= tolerance
    return np.where(near, order[nearest], -1)


def _rows(table: dict[str, NDArray[Any]], cloud: Cloud) -> NDArray[np.int64]:
    """Row of the table of each point of a cloud, -1 where there is none."""
    if {"sensor", "zone"} <= set(table):
        rows = _rows_by_zone(table, cloud)
        known = rows >= 0
        positions = np.stack([table[axis].take(rows[known]) for axis in ("x", "y", "z")])
        distance = np.linalg.norm(positions - cloud.points.compress(known, axis=0).T, axis=0)
        # Other writers may number the sensors in another order; then the positions disagree.
        if len(distance) and np.median(distance) <= _NEAREST:
            return rows
    return _rows_by_position(table, cloud)


def _rows_by_zone(table: dict[str, NDArray[Any]], cloud: Cloud) -> NDArray[np.int64]:
    sensors, _, columns = cloud.ranges.shape
    rows = np.full(cloud.ranges.size, -1, dtype=np.int64)
    zones = cloud.ranges[0].size
    sensor, zone = table["sensor"], table["zone"]
    inside = np.flatnonzero((sensor >= 0) & (sensor < sensors) & (zone >= 0) & (zone < zones))
    # Zones are numbered in the sensor's own grid in the file, in the largest grid in a cloud.
    own = np.isfinite(cloud.directions[:, 0, :, 0]).sum(axis=-1)[sensor[inside]]
    row, column = np.divmod(zone[inside], np.maximum(own, 1))
    index = sensor[inside] * zones + row * columns + column
    known = row < cloud.ranges.shape[1]
    rows[index[known]] = inside[known]
    return rows[cloud.sensor * zones + cloud.zone]


def _rows_by_position(table: dict[str, NDArray[Any]], cloud: Cloud) -> NDArray[np.int64]:
    from scipy.spatial import KDTree

    points = np.stack([table[axis] for axis in ("x", "y", "z")], axis=-1)
    real = np.flatnonzero(np.isfinite(points).all(axis=1))
    if len(real) == 0 or len(cloud.points) == 0:
        return np.full(len(cloud.points), -1, dtype=np.int64)
    distance, row = KDTree(points[real]).query(cloud.points)
    return np.where(distance <= _NEAREST, real[row], -1)
