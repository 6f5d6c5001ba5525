"""The window of frames that a method looks at."""

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
    """Frames k-n to k of a recording, or a pair of clouds; nothing in it is ever changed.

    Attributes:
        frames: in order; the first is the source, the last the target. Frames between are read
            when they are asked for. A pair of plain arrays gives two.
        stamps: (F,) seconds of the frames, increasing.
        stages: results of the estimator's stages for this window, shared between estimates.
    """

    frames: Sequence[Cloud]
    stamps: NDArray[np.float64]
    stages: Stages = field(default_factory=Stages, repr=False, compare=False)

    @property
    def source(self) -> Cloud:
        """P_{k-n}: the cloud whose points get a flow."""
        return self.frames[0]

    @property
    def target(self) -> Cloud:
        """P_k, in the same frame of reference."""
        return self.frames[-1]

    @property
    def interval(self) -> float:
        """Seconds from the source's stamp to the target's, above zero."""
        return float(self.stamps[-1] - self.stamps[0])


class LazyFrames(Sequence[Cloud]):
    """Frames that are loaded when they are first asked for.

    Args:
        count: number of frames.
        load: gives the frame at an index; it may be called twice where two threads ask at once.
        loaded: {index: frame} of those that are there already.
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
        """A frame, or several; errors of loading come through."""
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
    """Check a pair of clouds and bring it into a window's form.

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
    seconds = float(interval)
    frames = (plain_cloud("source", source, 0.0), plain_cloud("target", target, seconds))
    return Window(frames, np.array([0.0, seconds]))
