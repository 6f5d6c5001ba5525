"""A time-of-flight sensor: how its readings become points."""

from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray


@dataclass(frozen=True)
class SensorModel:
    """A multizone time-of-flight sensor, as a pinhole camera whose pixels are zones.

    The optical frame is REP 103's: x right, y down, z forward. Readings are kept in rows from up
    to down and columns from left to right, looking outward; `reading_order` and the flips say how
    the driver delivers them.

    Attributes:
        name: type of the sensor.
        rows: zones from up to down.
        columns: zones from left to right.
        field_of_view: angle from the left edge of the field of view to the right one, rad.
        min_range: smallest reading that counts, m.
        max_range: largest reading that counts, m.
        distance: what a reading is: along the optical axis, or along the zone's own ray.
        reading_order: whether readings run along rows or along columns.
        flip_vertical: whether the driver's first row is the lowest.
        flip_horizontal: whether the driver's first column is the rightmost.
        vertical_field_of_view: angle from its upper edge to the lower one, rad; None where the
            field of view is square.
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
        """Focal length along x, in columns: the outer edges of the outer zones bound the view."""
        return 0.5 * self.columns / np.tan(0.5 * self.field_of_view)

    @property
    def vertical_focal_length(self) -> float:
        """Focal length along y, in rows, likewise."""
        across = self.field_of_view
        down = across if self.vertical_field_of_view is None else self.vertical_field_of_view
        return 0.5 * self.rows / np.tan(0.5 * down)

    @cached_property
    def directions(self) -> NDArray[np.float64]:
        """(rows, columns, 3): a reading times its direction is the point in the optical frame."""
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
        """Whether the driver's images may be of this size."""
        turned = self.reading_order == "column_major" and (columns, rows) == (
            self.rows,
            self.columns,
        )
        return turned or (rows, columns) == (self.rows, self.columns)

    def arrange(self, readings: NDArray[Any]) -> NDArray[Any]:
        """Bring readings as the driver delivers them into this model's order (rows, columns)."""
        if self.reading_order == "column_major":
            # A driver may call its images rows x columns all the same.
            readings = readings.reshape(self.columns, self.rows).T
        if self.flip_vertical:
            readings = readings[::-1]
        if self.flip_horizontal:
            readings = readings[:, ::-1]
        return readings

    def of_depth_images(self) -> "SensorModel":
        """The same sensor where its readings are in order and along the optical axis already."""
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
        rows: zones from up to down.
        columns: zones from left to right.
        fx: focal length along x, in zones; likewise `fy`.
        fy: focal length along y, in zones.
        cx: column of the optical axis, counted from the centre of the first; likewise `cy`.
        cy: row of the optical axis.

    Returns:
        (rows, columns, 3) in the optical frame, each with z = 1.
    """
    v, u = np.mgrid[0:rows, 0:columns]
    return np.stack([(u - cx) / fx, (v - cy) / fy, np.ones((rows, columns))], axis=-1)


def unit(vectors: NDArray[np.float64]) -> NDArray[np.float64]:
    """Scale vectors (..., 3) to length 1."""
    return vectors / np.linalg.norm(vectors, axis=-1, keepdims=True)
