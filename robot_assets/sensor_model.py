"""Intrinsics of a time-of-flight sensor, and the order of its readings."""

from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray


@dataclass(frozen=True)
class SensorModel:
    """Multizone time-of-flight sensor, modelled as a pinhole camera whose pixels are zones.

    The optical frame is REP 103's: x right, y down, z forward. Readings are kept in rows from top
    to bottom and columns from left to right, looking outward; `reading_order` and the flips
    describe how the driver delivers them.

    Attributes:
        name: type of the sensor.
        rows: number of zones from top to bottom.
        columns: number of zones from left to right.
        field_of_view: horizontal angle between the outer edges of the field of view, rad.
        min_range: smallest valid reading, m.
        max_range: largest valid reading, m.
        distance: perpendicular: readings are along the optical axis; radial: along the zone's ray.
        reading_order: whether the driver delivers readings row by row or column by column.
        flip_vertical: whether the driver's first row is the lowest.
        flip_horizontal: whether the driver's first column is the rightmost.
        vertical_field_of_view: vertical angle likewise, rad; None where it is the same.
    """

    name: str = "VL53L5CX"
    rows: int = 8
    columns: int = 8
    field_of_view: float = np.pi / 4
    min_range: float = 0.02
    max_range: float = 4.0
    distance: Literal["perpendicular", "radial"] = "perpendicular"
    reading_order: Literal["row_major", "column_major"] = "row_major"
    flip_vertical: bool = False
    flip_horizontal: bool = False
    vertical_field_of_view: float | None = None

    @property
    def focal_length(self) -> float:
        """Focal length along x, in columns."""
        return 0.5 * self.columns / np.tan(0.5 * self.field_of_view)

    @property
    def vertical_focal_length(self) -> float:
        """Focal length along y, in rows."""
        across = self.field_of_view
        down = across if self.vertical_field_of_view is None else self.vertical_field_of_view
        return 0.5 * self.rows / np.tan(0.5 * down)

    @cached_property
    def directions(self) -> NDArray[np.float64]:
        """(rows, columns, 3); a reading times its direction is the point in the optical frame."""
        rays = zone_rays(
            self.rows,
            self.columns,
            self.focal_length,
            self.vertical_focal_length,
            0.5 * (self.columns - 1),
            0.5 * (self.rows - 1),
        )
        return rays if self.distance == "perpendicular" else unit(rays)

    def delivers(self, rows: int, columns: int) -> bool:
        """Whether the driver's images can have this size."""
        transposed = self.reading_order == "column_major" and (columns, rows) == (
            self.rows,
            self.columns,
        )
        return transposed or (rows, columns) == (self.rows, self.columns)

    def arrange(self, readings: NDArray[Any]) -> NDArray[Any]:
        """Reorder readings as delivered by the driver into this model's (rows, columns)."""
        if self.reading_order == "column_major":
            # The shape cannot be trusted: a driver may label these images rows x columns, too.
            readings = readings.reshape(self.columns, self.rows).T
        if self.flip_vertical:
            readings = readings[::-1]
        if self.flip_horizontal:
            readings = readings[:, ::-1]
        return readings

    def of_depth_images(self) -> "SensorModel":
        """The same sensor with readings as in a depth image: in order, along the optical axis."""
        return replace(
            self,
            distance="perpendicular",
            reading_order="row_major",
            flip_vertical=False,
            flip_horizontal=False,
        )


def zone_rays(
    rows: int, columns: int, fx: float, fy: float, cx: float, cy: float
) -> NDArray[np.float64]:
    """Rays through the centres of the zones of a pinhole camera.

    Args:
        rows: number of zones from top to bottom.
        columns: number of zones from left to right.
        fx: focal length along x, in zones.
        fy: focal length along y, in zones.
        cx: column of the optical axis, 0 at the centre of the first column.
        cy: row of the optical axis, 0 at the centre of the first row.

    Returns:
        (rows, columns, 3) in the optical frame, each with z = 1.
    """
    v, u = np.mgrid[0:rows, 0:columns]
    return np.stack([(u - cx) / fx, (v - cy) / fy, np.ones((rows, columns))], axis=-1)


def unit(vectors: NDArray[np.float64]) -> NDArray[np.float64]:
    """Scale vectors (..., 3) to length 1."""
    return vectors / np.linalg.norm(vectors, axis=-1, keepdims=True)
