"""The two clouds that an estimate looks at."""

import math
from dataclasses import dataclass, field
from numbers import Real
from typing import Protocol, runtime_checkable

import numpy as np
from numpy.typing import ArrayLike, NDArray

from estimator.stages import Stages

_FARTHEST = 1e100  # metres; squares of what is larger overflow, and HDBSCAN then never returns


class CloudError(ValueError):
    """A cloud or an interval from which nothing can be estimated."""


@runtime_checkable
class HasPoints(Protocol):
    """Anything with points, such as a cloud of a recording."""

    @property
    def points(self) -> NDArray[np.float64]:
        """(N, 3) metres."""
        ...


@dataclass(frozen=True)
class CloudPair:
    """Source and target of an estimate; nobody changes the clouds while it is used.

    Attributes:
        source: (N, 3) metres, P_{k-n}.
        target: (M, 3) metres, P_k, in the same frame.
        interval: seconds between the two stamps, above zero.
        stages: what was found out about the pair already.
    """

    source: NDArray[np.float64]
    target: NDArray[np.float64]
    interval: float
    stages: Stages = field(default_factory=Stages, repr=False, compare=False)


def cloud_pair(
    source: ArrayLike | HasPoints, target: ArrayLike | HasPoints, interval: float
) -> CloudPair:
    """Check the input of an estimate and bring it into one form.

    Args:
        source: (N, 3) metres, or a cloud; N may be 0, rows may hold NaN.
        target: (M, 3) metres, or a cloud, likewise.
        interval: seconds between the two stamps.

    Raises:
        CloudError: a wrong shape, type or size; an interval that is no finite number above zero.
    """
    if not isinstance(interval, Real) or not math.isfinite(interval) or interval <= 0:
        raise CloudError(
            f"The interval must be a finite number of seconds above 0, got {interval!r}."
        )
    return CloudPair(_points("source", source), _points("target", target), float(interval))


def _points(name: str, cloud: ArrayLike | HasPoints) -> NDArray[np.float64]:
    values = cloud.points if isinstance(cloud, HasPoints) else cloud
    try:
        points = np.asarray(values, dtype=np.float64)
    except (TypeError, ValueError) as error:
        raise CloudError(f"The {name} must hold numbers: {error}.") from error
    if points.shape == (0,):  # an empty list says nothing of its columns
        return np.zeros((0, 3))
    if points.ndim != 2 or points.shape[1] != 3:
        raise CloudError(f"The {name} must have the shape (N, 3), got {points.shape}.")
    farthest = np.abs(points, where=np.isfinite(points), out=np.zeros_like(points)).max(initial=0.0)
    if farthest > _FARTHEST:
        raise CloudError(f"The {name} must lie within {_FARTHEST:g} m, got {farthest:g} m.")
    return points
