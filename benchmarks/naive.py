"""The naive pipeline that benchmarks measure against: scikit-learn's HDBSCAN, Open3D's ICP."""

import numpy as np
from numpy.typing import NDArray

from estimator import Window
from estimator.engines import REFERENCE
from tests.estimator.judge import judge

Points = NDArray[np.float64]


def cluster(points: Points) -> NDArray[np.int64]:
    """Labels of a merged cloud with the default parameters."""
    return REFERENCE.labels(points, 20, None, False)


def flow(window: Window) -> tuple[NDArray[np.int64], Points]:
    """Labels and velocities of a pair with the default parameters."""
    return judge(window.source.points, window.target.points, window.interval)
