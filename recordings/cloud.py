"""The cloud of one frame, and where its points came from."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray


@dataclass(frozen=True)
class Cloud:
    """What the sensors saw at one frame.

    Attributes:
        points: (N, 3) metres in the fixed frame.
        sensor: (N,) index of the sensor that saw each point.
        zone: (N,) index of its zone, row * 8 + column.
        ranges: (S, 8, 8) metres as the sensors report them, NaN where invalid; readings of the
            robot itself and beyond `max_range` are still in here.
        T_fixed_sensor: (S, 4, 4), NaN where unknown.
        stamp: seconds.
    """

    points: NDArray[np.float64]
    sensor: NDArray[np.int64]
    zone: NDArray[np.int64]
    ranges: NDArray[np.float64]
    T_fixed_sensor: NDArray[np.float64]
    stamp: float


@dataclass(frozen=True)
class Reading:
    """All readings of one frame before a maximum range is applied.

    Attributes:
        stamp: seconds.
        ranges: (S, 8, 8) metres, NaN where invalid.
        T_fixed_sensor: (S, 4, 4), NaN where unknown.
        points: (S, 8, 8, 3) metres in the fixed frame, NaN where invalid or unknown.
        distance: (S, 8, 8) metres along the zone's ray.
        visible: (S, 8, 8) whether a reading is valid, placed, and not the robot itself.
    """

    stamp: float
    ranges: NDArray[np.float64]
    T_fixed_sensor: NDArray[np.float64]
    points: NDArray[np.float64]
    distance: NDArray[np.float64]
    visible: NDArray[np.bool_]

    def cloud(self, max_range: float) -> Cloud:
        """The cloud of the visible readings no further than `max_range` along their rays."""
        kept = self.visible & (self.distance <= max_range)
        sensor, row, column = np.nonzero(kept)
        return Cloud(
            points=self.points[kept],
            sensor=sensor,
            zone=row * self.ranges.shape[2] + column,
            ranges=self.ranges,
            T_fixed_sensor=self.T_fixed_sensor,
            stamp=self.stamp,
        )
