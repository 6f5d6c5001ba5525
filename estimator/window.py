"""Window of frames, the input of a method."""

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from numbers import Real
from types import MappingProxyType
from typing import overload

import numpy as np
from numpy.typing import ArrayLike, NDArray

from estimator.cloud import Cloud, CloudError, HasPoints, plain_cloud, with_checked_points
from estimator.stages import Stages


@dataclass(frozen=True)
class Window:
    """Frames k-n to k of a recording, or a pair of clouds; immutable.

    Attributes:
        frames: in order; the first is the source, the last the target. Frames between are read
            on first access. A pair of plain arrays gives two.
        stamps: (F,) seconds of the frames, increasing.
        stages: cache of intermediate results for this window, shared between estimates.
    """

    frames: Sequence[Cloud]
    stamps: NDArray[np.float64]
    stages: Stages = field(default_factory=Stages, repr=False, compare=False)

    @property
    def source(self) -> Cloud:
        """P_{k-n}, the cloud whose points get a flow."""
        return self.frames[0]

    @property
    def target(self) -> Cloud:
        """P_k, in the same coordinate frame."""
        return self.frames[-1]

    @property
    def interval(self) -> float:
        """Seconds from the source's stamp to the target's, above zero."""
        return float(self.stamps[-1] - self.stamps[0])


class LazyFrames(Sequence[Cloud]):
    """Frames that are loaded on first access.

    Args:
        count: number of frames.
        load: returns the frame at an index; two threads may both call it.
        loaded: {index: frame} of frames that are loaded already.
    """

    def __init__(
        self,
        count: int,
        load: Callable[[int], Cloud],
        loaded: Mapping[int, Cloud] = MappingProxyType({}),
    ) -> None:
        self._count = count
        self._load = load
        self._loaded = {at: _checked(at, frame) for at, frame in loaded.items()}

    def __len__(self) -> int:
        return self._count

    @overload
    def __getitem__(self, index: int) -> Cloud: ...
    @overload
    def __getitem__(self, index: slice) -> Sequence[Cloud]: ...
    def __getitem__(self, index: int | slice) -> Cloud | Sequence[Cloud]:
        """Return a frame or several; errors of `load` are passed on."""
        if isinstance(index, slice):
            return [self[i] for i in range(*index.indices(self._count))]
        at = index + self._count if index < 0 else index
        if not 0 <= at < self._count:
            raise IndexError(f"There are {self._count} frames, and not one at {index}.")
        if at not in self._loaded:
            self._loaded[at] = _checked(at, self._load(at))
        return self._loaded[at]


def _checked(index: int, frame: Cloud) -> Cloud:
    return with_checked_points(f"frame {index} of the window", frame)


def window_of_pair(
    source: ArrayLike | HasPoints, target: ArrayLike | HasPoints, interval: float
) -> Window:
    """Check a pair of clouds and make a window of it.

    Args:
        source: (N, 3) metres, or a cloud; N may be 0, rows may hold NaN.
        target: (M, 3) metres, or a cloud, likewise.
        interval: seconds between the two stamps.

    Raises:
        CloudError: a cloud has a wrong shape, type or size, or the interval is not a finite number
            above zero.
    """
    if not isinstance(interval, Real) or not math.isfinite(interval) or interval <= 0:
        raise CloudError(
            f"The interval must be a finite number of seconds above 0, got {interval!r}."
        )
    seconds = float(interval)
    frames = (plain_cloud("source", source, 0.0), plain_cloud("target", target, seconds))
    return Window(frames, np.array([0.0, seconds]))
