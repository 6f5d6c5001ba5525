"""What is known of a zone and of the point that it measured."""

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from app.analysis.moving_targets import moving_targets
from app.analysis.pairs import Pair
from app.analysis.selection import cluster_of
from app.analysis.zones import (
    SOURCE,
    TARGET,
    Zone,
    ZoneState,
    along_rays,
    cloud_of,
    cluster_of_point,
    frame_of,
    point_of_zone,
    zone_states,
)
from estimator import MOVING_SPEED, Label
from recordings import Recording

Vector = tuple[float, float, float]


@dataclass(frozen=True)
class PointAnswer:
    """All that is known of a point; None where something is not.

    Attributes:
        position: (3,) metres in the fixed frame.
        cluster: index in the pair's flow.
        label: of the point; of a target point MOVING where it belongs to what moves, else None.
        velocity: of a source point, m/s.
        cluster_velocity: of a target point, m/s: the mean of its moving cluster.
        truth: true velocity, m/s: of a source point the mean over the pair, of a target point that
            at the frame.
    """

    position: Vector
    cluster: int | None = None
    label: Label | None = None
    velocity: Vector | None = None
    cluster_velocity: Vector | None = None
    truth: Vector | None = None

    @property
    def error(self) -> float | None:
        """Length of the difference between velocity and truth, m/s."""
        if self.velocity is None or self.truth is None:
            return None
        return float(np.linalg.norm(np.subtract(self.velocity, self.truth)))

    @property
    def truly_moves(self) -> bool:
        """Whether the truth is known to move."""
        return self.truth is not None and bool(np.linalg.norm(self.truth) > MOVING_SPEED)


@dataclass(frozen=True)
class Answer:
    """All that is known of a zone of a pair.

    Attributes:
        zone: of the pair.
        frame: of the zone's cloud.
        sensor: its name.
        state: what the zone is.
        status: ST's target status, None where none was recorded.
        along_axis: distance along the sensor's optical axis, metres, NaN without one.
        along_ray: distance along the zone's ray, likewise.
        lateness: seconds from the frame's stamp to the sensor's own; below zero the last message
            of a sensor that has none in the frame; NaN without any.
        origin: (3,) of the ray in the fixed frame, metres; None where the sensor's pose is unknown.
        direction: (3,) of the ray, a unit vector in the fixed frame; likewise.
        point: that the zone measured, None without one.
    """

    zone: Zone
    frame: int
    sensor: str
    state: ZoneState
    status: int | None
    along_axis: float
    along_ray: float
    lateness: float
    origin: Vector | None
    direction: Vector | None
    point: PointAnswer | None


def answer(recording: Recording, pair: Pair, zone: Zone, max_range: float) -> Answer | None:
    """What is known of a zone of a pair, None where the pair has no such cloud.

    Args:
        recording: of the pair; it has the zone.
        pair: with its flow, if there is one.
        zone: to look at.
        max_range: of the pair's clouds, metres.

    Raises:
        RecordingError: the file is broken at the truth.
    """
    cloud = cloud_of(pair, zone.side)
    if cloud is None:
        return None
    frame, at = frame_of(pair, zone.side), (zone.sensor, zone.row, zone.column)
    messages = recording.latest_messages(frame)
    pose = cloud.T_fixed_sensor[zone.sensor]
    placed = bool(np.isfinite(pose).all())
    index = point_of_zone(cloud, zone)
    if index is None:
        point = None
    elif zone.side == TARGET:
        point = _of_target(recording, pair, index, max_range)
    else:
        point = _of_source(pair, index)
    return Answer(
        zone=zone,
        frame=frame,
        sensor=recording.sensors[zone.sensor].name,
        state=ZoneState(int(zone_states(cloud, max_range, messages)[at])),
        status=None if cloud.status is None else int(cloud.status[at]),
        along_axis=float(cloud.ranges[at]),
        along_ray=float(along_rays(cloud)[at]),
        lateness=float(messages[zone.sensor] - cloud.stamp),
        origin=_vector(pose[:3, 3]) if placed else None,
        direction=_vector(pose[:3, :3] @ cloud.directions[at]) if placed else None,
        point=point,
    )


def _of_source(pair: Pair, index: int) -> PointAnswer:
    assert pair.source is not None
    point = PointAnswer(
        _vector(pair.source.points[index]),
        truth=_row(pair.truth.points if pair.truth else None, index),
    )
    if pair.flow is None:
        return point
    return replace(
        point,
        cluster=cluster_of_point(pair, SOURCE, index),
        label=Label(int(pair.flow.label[index])),
        velocity=_row(pair.flow.velocity, index),
    )


def _of_target(recording: Recording, pair: Pair, index: int, max_range: float) -> PointAnswer:
    point = PointAnswer(
        _vector(pair.target.points[index]),
        cluster=cluster_of_point(pair, TARGET, index),
        truth=_row(recording.point_truth(pair.frame, max_range), index),
    )
    if not moving_targets(pair)[index]:
        return point
    cluster = cluster_of(pair, point.cluster)
    known = cluster is not None and bool(np.isfinite(cluster.velocity).any())
    mean = _vector(np.nanmean(cluster.velocity, axis=0)) if cluster and known else None
    return replace(point, label=Label.MOVING, cluster_velocity=mean)


def _row(values: NDArray[np.float64] | None, index: int) -> Vector | None:
    """A row (3,) of values (N, 3), None where it is not known."""
    if values is None or not np.isfinite(values[index]).all():
        return None
    return _vector(values[index])


def _vector(values: NDArray[np.float64]) -> Vector:
    x, y, z = values.tolist()
    return x, y, z
