"""Point cloud of one frame, with the rays that its points were measured along."""

from dataclasses import dataclass
from typing import Any, TypeVar

import numpy as np
from numpy.typing import NDArray

_Array = TypeVar("_Array", bound=NDArray[Any])

NO_STATUS = 255
"""ST's status of a zone without a target; also used where no status was recorded."""


@dataclass(frozen=True)
class Cloud:
    """Points that the sensors measured at one frame, and their rays; arrays are read-only.

    R and C are the largest numbers of rows and columns of any sensor of the recording. A smaller
    sensor fills the first of them; its directions beyond are NaN. A zone with a direction and
    without a range had no valid return.

    Attributes:
        points: (N, 3) metres in the fixed frame.
        sensor: (N,) index of each point's sensor.
        zone: (N,) index of its zone, row * C + column.
        directions: (S, R, C, 3) unit vectors along the zones' rays in each sensor's optical frame,
            NaN beyond its grid.
        ranges: (S, R, C) metres along the optical axis, NaN without a valid return; readings of
            the robot itself and beyond `max_range` are included.
        T_fixed_sensor: (S, 4, 4), NaN where unknown.
        stamp: seconds.
        status: (S, R, C) ST's target status as recorded, 255 where a sensor has none at this frame
            and beyond its grid; None where no sensor has any.
    """

    points: NDArray[np.float64]
    sensor: NDArray[np.int64]
    zone: NDArray[np.int64]
    directions: NDArray[np.float64]
    ranges: NDArray[np.float64]
    T_fixed_sensor: NDArray[np.float64]
    stamp: float
    status: NDArray[np.uint8] | None = None


@dataclass(frozen=True)
class Reading:
    """All readings of one frame before a maximum range is applied; its arrays are read-only.

    Attributes:
        stamp: seconds.
        directions: as in `Cloud`, likewise `ranges`, `status` and `T_fixed_sensor`.
        ranges: (S, R, C) metres.
        status: (S, R, C), or None.
        T_fixed_sensor: (S, 4, 4).
        points: (S, R, C, 3) metres in the fixed frame, NaN where invalid or unknown.
        distance: (S, R, C) metres along the zone's ray.
        visible: (S, R, C) whether a reading is valid, of a known pose, and not the robot itself.
    """

    stamp: float
    directions: NDArray[np.float64]
    ranges: NDArray[np.float64]
    status: NDArray[np.uint8] | None
    T_fixed_sensor: NDArray[np.float64]
    points: NDArray[np.float64]
    distance: NDArray[np.float64]
    visible: NDArray[np.bool_]

    def cloud(self, max_range: float) -> Cloud:
        """Cloud of the visible readings up to `max_range` metres along their rays."""
        kept = np.flatnonzero(self.visible & (self.distance <= max_range))
        sensor, zone = np.divmod(kept, self.ranges[0].size)
        return Cloud(
            points=read_only(self.points.reshape(-1, 3).take(kept, axis=0)),
            sensor=read_only(sensor),
            zone=read_only(zone),
            directions=self.directions,
            ranges=self.ranges,
            T_fixed_sensor=self.T_fixed_sensor,
            stamp=self.stamp,
            status=self.status,
        )


def read_only(values: _Array) -> _Array:
    """Make an array read-only and return it; clouds are shared between threads."""
    values.setflags(write=False)
    return values
