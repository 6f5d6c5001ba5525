"""Perspective projection of a drawing onto a picture, and the camera whose picture points fill."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from app.scene.camera import Camera
from app.scene.first_view import View
from app.scene.rendering import looking

_MARGIN = 0.07  # of the picture, on each side
_LEAST_DISTANCE = 0.3  # metres


@dataclass(frozen=True)
class Pinhole:
    """Camera and the picture that it takes.

    Attributes:
        camera: pose and field of view, in the drawing's frame.
        width: of the picture, in any unit.
        height: of the picture, in the same unit.
    """

    camera: Camera
    width: float
    height: float

    @property
    def axes(self) -> NDArray[np.float64]:
        """Orientation (3, 3): columns to the right, down, and forward, in the drawing's frame."""
        return looking(View(np.array(self.camera.position), np.array(self.camera.look_at)))

    def project(
        self, points: NDArray[np.float64]
    ) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """Where points (..., 3) of the drawing are in the picture.

        Returns:
            (..., 2) from the upper left corner, to the right and down, and the distance (...,)
            along the optical axis in metres. Behind the camera, where that is not positive, there
            is no place in the picture: it is NaN.
        """
        seen = (points - np.array(self.camera.position)) @ self.axes
        depth = seen[..., 2]
        with np.errstate(divide="ignore", invalid="ignore"):
            slopes = np.where(depth[..., None] > 0, seen[..., :2] / depth[..., None], np.nan)
        scale = self.height / 2 / np.tan(self.camera.fov / 2)
        return slopes * scale + np.array([self.width, self.height]) / 2, depth


def filling(
    camera: Camera, aspect: float, points: NDArray[np.float64], free_below: float = 0.0
) -> Camera:
    """The camera, moved without a turn until points (N, 3) just fill its picture.

    Args:
        camera: whose direction and field of view are kept.
        aspect: width by height of the picture.
        points: in the drawing's frame, metres; without any the camera stays.
        free_below: part of the picture's height that stays free at its lower edge.
    """
    if len(points) == 0:
        return camera
    axes = Pinhole(camera, aspect, 1.0).axes
    right, down, forward = (points @ axes).T
    slope = np.tan(camera.fov / 2)
    sides = (1 - 2 * _MARGIN) * slope
    # Every point bounds where the camera may be on both sides; its picture is full where the
    # bounds meet.
    bounds = (
        _bounds(right, forward, aspect * sides, aspect * sides),
        _bounds(down, forward, sides, (1 - 2 * max(_MARGIN, free_below)) * slope),
    )
    nearest = float(forward.min())
    back = min(*(bound.end for bound in bounds), nearest - _LEAST_DISTANCE)
    at = np.array([*(bound.middle(back) for bound in bounds), back])
    ahead = max(float(np.median(forward)) - at[2], _LEAST_DISTANCE)
    position = axes @ at
    return Camera.of(position, position + ahead * axes[:, 2], camera.fov)


@dataclass(frozen=True)
class _Bounds:
    """Where a camera c may be along an axis of its picture: low + after b <= c <= high - before b.

    Here b is the camera's place along its optical axis, which is `end` at most.
    """

    low: float
    high: float
    before: float
    after: float

    @property
    def end(self) -> float:
        return (self.high - self.low) / (self.before + self.after)

    def middle(self, back: float) -> float:
        return (self.low + self.after * back + self.high - self.before * back) / 2


def _bounds(
    along: NDArray[np.float64], forward: NDArray[np.float64], before: float, after: float
) -> _Bounds:
    """Bounds by points (N,) along an axis, for slopes of the rays at its beginning and end."""
    low = float((along - after * forward).max())
    high = float((along + before * forward).min())
    return _Bounds(low, high, before, after)
