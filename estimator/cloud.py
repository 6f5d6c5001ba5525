"""Clouds as methods see them: points, and the rays of the zones that measured them."""

from dataclasses import dataclass, field
from typing import Any, Protocol, TypeGuard, runtime_checkable

import numpy as np
from numpy.typing import ArrayLike, NDArray

_FARTHEST = 1e100  # metres; squares of larger values overflow, and HDBSCAN then never returns


class CloudError(ValueError):
    """Cloud or interval that no flow can be estimated from."""


@runtime_checkable
class HasPoints(Protocol):
    """Object with points, such as a cloud of a recording."""

    @property
    def points(self) -> NDArray[np.float64]:
        """(N, 3) metres."""
        ...


@runtime_checkable
class Cloud(HasPoints, Protocol):
    """One frame as methods see it: a cloud of a recording or a `PlainCloud`.

    S sensors have grids of at most R rows and C columns of zones. Arrays are read-only.
    """

    @property
    def stamp(self) -> float:
        """Seconds."""
        ...

    @property
    def sensor(self) -> NDArray[np.int64]:
        """(N,) index of each point's sensor, -1 where it has none."""
        ...

    @property
    def zone(self) -> NDArray[np.int64]:
        """(N,) index of each point's zone, row * C + column, -1 where it has none."""
        ...

    @property
    def directions(self) -> NDArray[np.float64]:
        """(S, R, C, 3) unit rays in each sensor's frame, NaN beyond a sensor's own grid."""
        ...

    @property
    def ranges(self) -> NDArray[np.float64]:
        """(S, R, C) metres along the optical axis, NaN where a zone has no return."""
        ...

    @property
    def status(self) -> NDArray[np.uint8] | None:
        """(S, R, C) ST's target status, None where it was not recorded."""
        ...

    @property
    def T_fixed_sensor(self) -> NDArray[np.float64]:  # noqa: N802 (a transformation)
        """(S, 4, 4) poses of the sensors, NaN where unknown."""
        ...


@dataclass(frozen=True)
class PlainCloud:
    """Points without sensors: a `Cloud` without rays; attributes as there."""

    points: NDArray[np.float64]
    sensor: NDArray[np.int64]
    zone: NDArray[np.int64]
    stamp: float = 0.0
    directions: NDArray[np.float64] = field(default_factory=lambda: _empty(0, 0, 0, 3))
    ranges: NDArray[np.float64] = field(default_factory=lambda: _empty(0, 0, 0))
    status: NDArray[np.uint8] | None = None
    T_fixed_sensor: NDArray[np.float64] = field(default_factory=lambda: _empty(0, 4, 4))


def plain_cloud(name: str, values: ArrayLike | HasPoints, stamp: float) -> Cloud:
    """Check points, or those of a cloud, and return them as a cloud.

    Args:
        name: of the cloud, for the error message.
        values: (N, 3) metres, an object with such points, or a cloud, which is returned itself.
        stamp: seconds, for points without a stamp.

    Raises:
        CloudError: the points have a wrong shape, type or size.
    """
    if _is_cloud(values):
        return with_checked_points(name, values)
    points = _checked_points(name, values.points if isinstance(values, HasPoints) else values)
    nowhere = read_only(np.full(len(points), -1, dtype=np.int64))
    return PlainCloud(points, nowhere, nowhere, stamp)


def with_checked_points(name: str, cloud: Cloud) -> Cloud:
    """Check the points of a cloud and return the cloud.

    Raises:
        CloudError: its points have a wrong shape, type or size.
    """
    _checked_points(name, cloud.points)
    return cloud


def read_only(values: NDArray[Any]) -> NDArray[Any]:
    """Make an array read-only and return it."""
    values.setflags(write=False)
    return values


def _empty(*shape: int) -> NDArray[np.float64]:
    return read_only(np.zeros(shape))


def _is_cloud(values: object) -> TypeGuard[Cloud]:
    return isinstance(values, Cloud)


def _checked_points(name: str, values: ArrayLike) -> NDArray[np.float64]:
    try:
        points = np.asarray(values, dtype=np.float64)
    except (TypeError, ValueError) as error:
        raise CloudError(f"The {name} must hold numbers: {error}.") from error
    if points.shape == (0,):  # an empty list has no columns to check
        return read_only(np.zeros((0, 3)))
    if points.ndim != 2 or points.shape[1] != 3:
        raise CloudError(f"The {name} must have the shape (N, 3), got {points.shape}.")
    farthest = np.abs(points, where=np.isfinite(points), out=np.zeros_like(points)).max(initial=0.0)
    if farthest > _FARTHEST:
        raise CloudError(f"The {name} must lie within {_FARTHEST:g} m, got {farthest:g} m.")
    return read_only(points.view())
