"""Zones of the sensors: what each measured in a frame, or why it has no point."""

from dataclasses import dataclass
from enum import IntEnum
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from app.analysis.pairs import Pair
from recordings import NO_STATUS, VALID_STATUS, Cloud, Recording

SOURCE, TARGET = "source", "target"
Side = Literal["source", "target"]
"""Which cloud of a pair."""


class ZoneState(IntEnum):
    """What a zone of a frame is."""

    POINT = 0
    """It has a point in the cloud."""
    NO_TARGET = 1
    """It has no distance."""
    REFUSED = 2
    """Its status says that its distance is none."""
    TOO_FAR = 3
    """Its distance is beyond the maximum range."""
    ROBOT = 4
    """It sees the robot itself."""
    UNPLACED = 5
    """It has a distance, and the pose of its sensor is unknown."""
    NO_MESSAGE = 6
    """Its sensor has no message in the frame."""
    OUTSIDE = 7
    """Its sensor has fewer zones."""


STATUS_WORDS = {
    0: "not updated",
    1: "signal too low",
    2: "target phase",
    3: "sigma too high",
    4: "target not consistent",
    5: "valid",
    6: "wrap-around not checked",
    7: "rate not consistent",
    8: "signal too low for the target",
    9: "valid, large pulse",
    10: "valid, no target before",
    11: "measurement not consistent",
    12: "blurred by another target",
    13: "not consistent",
    NO_STATUS: "no target",
}
"""{ST's target status: what it says}."""


@dataclass(frozen=True)
class Zone:
    """A zone of one of a pair's clouds.

    Attributes:
        side: the cloud.
        sensor: index.
        row: from the top, as the sensor sees it.
        column: from the left.
    """

    side: Side
    sensor: int
    row: int
    column: int


def has_zone(recording: Recording, zone: Zone) -> bool:
    """Whether a recording has this zone; a browser may name any."""
    if zone.side not in (SOURCE, TARGET) or not 0 <= zone.sensor < len(recording.sensors):
        return False
    rows, columns = recording.sensors[zone.sensor].grid
    return 0 <= zone.row < rows and 0 <= zone.column < columns


def cloud_of(pair: Pair, side: Side) -> Cloud | None:
    """Source or target of a pair, None where it has no source."""
    return pair.source if side == SOURCE else pair.target


def frame_of(pair: Pair, side: Side) -> int:
    """Frame of a pair's source or target."""
    return pair.frame - pair.n if side == SOURCE else pair.frame


def zone_of_point(pair: Pair, side: Side, index: int) -> Zone:
    """The zone that measured a point of a pair's source or target."""
    cloud = cloud_of(pair, side)
    assert cloud is not None
    row, column = divmod(int(cloud.zone[index]), cloud.ranges.shape[2])
    return Zone(side, int(cloud.sensor[index]), row, column)


def point_of_zone(cloud: Cloud, zone: Zone) -> int | None:
    """Index of the point that a zone measured, None without one."""
    number = zone.row * cloud.ranges.shape[2] + zone.column
    found = np.flatnonzero((cloud.sensor == zone.sensor) & (cloud.zone == number))
    return int(found[0]) if len(found) else None


def cluster_of_point(pair: Pair, side: Side, index: int) -> int | None:
    """Index of the cluster that a point of a pair's source or target belongs to, None for none."""
    for cluster in pair.flow.clusters if pair.flow else ():
        if index in (cluster.source if side == SOURCE else cluster.target):
            return cluster.index
    return None


def along_rays(cloud: Cloud) -> NDArray[np.float64]:
    """Distances (S, R, C) along the zones' rays, metres, NaN where invalid."""
    return cloud.ranges / cloud.directions[..., 2]


def zone_states(cloud: Cloud, max_range: float, messages: NDArray[np.float64]) -> NDArray[np.uint8]:
    """`ZoneState` (S, R, C) of all zones of a cloud.

    Args:
        cloud: of the frame.
        max_range: metres along the zones' rays, as the cloud was made with.
        messages: (S,) stamps of each sensor's last message up to the frame, NaN without one.
    """
    states = np.full(cloud.ranges.shape, ZoneState.NO_TARGET, dtype=np.uint8)
    if cloud.status is not None:
        refused = ~np.isin(cloud.status, (*VALID_STATUS, NO_STATUS))
        states[refused] = ZoneState.REFUSED
    measured = np.isfinite(cloud.ranges)
    placed: NDArray[np.bool_] = np.all(np.isfinite(cloud.T_fixed_sensor), axis=(1, 2))
    states[measured] = ZoneState.UNPLACED
    states[measured & placed[:, None, None]] = ZoneState.ROBOT
    states[measured & (along_rays(cloud) > max_range)] = ZoneState.TOO_FAR
    columns = cloud.ranges.shape[2]
    states[cloud.sensor, cloud.zone // columns, cloud.zone % columns] = ZoneState.POINT
    there: NDArray[np.bool_] = np.greater_equal(messages, cloud.stamp)
    states[~there] = ZoneState.NO_MESSAGE
    states[~np.isfinite(cloud.directions).all(axis=-1)] = ZoneState.OUTSIDE
    return states
