"""The naive pipeline that benchmarks measure against: scikit-learn's HDBSCAN, Open3D's ICP."""

from collections.abc import Callable
from functools import partial
from itertools import cycle, islice
from typing import Any

import numpy as np
from numpy.typing import NDArray

from benchmarks.inputs import sample_windows
from estimator import Window
from estimator.engines import REFERENCE
from tests.estimator.judge import judge

Points = NDArray[np.float64]


def cluster(points: Points) -> NDArray[np.int64]:
    """Labels of a merged cloud with the default parameters."""
    return REFERENCE.labels(points, 20, None, False)


def flow(window: Window, **changed: Any) -> tuple[NDArray[np.int64], Points]:  # noqa: ANN401
    """Labels and velocities of a pair; parameters are the default ones but those given."""
    return judge(window.source.points, window.target.points, window.interval, **changed)


def pairs_alone(count: int) -> list[Callable[[], object]]:
    """That many estimates of pairs of the samples: a yardstick for what has no naive way."""
    return [partial(flow, pair) for pair in islice(cycle(sample_windows()), count)]
