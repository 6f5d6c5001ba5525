"""The two engines: what computes HDBSCAN's labels and ICP's registrations.

The compiled one gives scikit-learn's labels, except that it breaks ties between equal edges by
their order, where scikit-learn's choice depends on the processor; and Open3D's registrations
within 1e-9. The reference is those two libraries themselves.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from estimator.icp import Registration
from estimator.icp import align as align_with_open3d
from estimator.libraries import scikit_learn_hdbscan

Labels = Callable[[NDArray[np.float64], int, int | None, bool], NDArray[np.int64]]
"""From points (N, 3) in metres, min_cluster_size, min_samples and allow_single_cluster to labels
(N,), -1 for noise."""

Align = Callable[[NDArray[np.float64], NDArray[np.float64], float], Registration]
"""As `estimator.icp.align`."""


@dataclass(frozen=True)
class Engine:
    """What computes the two costly steps of Algorithm 1.

    Attributes:
        name: for the command line and saved files.
        labels: clusters points with HDBSCAN.
        align: runs point-to-point ICP.
    """

    name: str
    labels: Labels
    align: Align


def _scikit_learn_labels(
    points: NDArray[np.float64],
    min_cluster_size: int,
    min_samples: int | None,
    allow_single_cluster: bool,
) -> NDArray[np.int64]:
    hdbscan = scikit_learn_hdbscan()(
        min_cluster_size=min_cluster_size,
        min_samples=min_samples,
        allow_single_cluster=allow_single_cluster,
        copy=True,
    )
    return hdbscan.fit_predict(points).astype(np.int64)


def _compiled_labels(
    points: NDArray[np.float64],
    min_cluster_size: int,
    min_samples: int | None,
    allow_single_cluster: bool,
) -> NDArray[np.int64]:
    from estimator.engine.hdbscan import hdbscan

    single = allow_single_cluster
    return hdbscan(points, min_cluster_size, min_samples, allow_single_cluster=single)[0]


def _compiled_align(
    source: NDArray[np.float64], target: NDArray[np.float64], max_correspondence_distance: float
) -> Registration:
    from estimator.engine.registration import align

    found = align(source, target, max_correspondence_distance)
    # Where points are equally near, Open3D's choice among them decides.
    return found or align_with_open3d(source, target, max_correspondence_distance)


COMPILED = Engine("compiled", _compiled_labels, _compiled_align)
REFERENCE = Engine("reference", _scikit_learn_labels, align_with_open3d)
ENGINES = {engine.name: engine for engine in (COMPILED, REFERENCE)}


class _Chosen:
    engine = COMPILED


def current_engine() -> Engine:
    """The engine of this process's estimates."""
    return _Chosen.engine


def use_engine(engine: Engine) -> None:
    """Choose the engine of this process's estimates; those that are running finish with theirs."""
    _Chosen.engine = engine


def warm_up(engine: Engine) -> None:
    """Run both steps once; the compiled engine's first run ever compiles it, in some 20 s."""
    steps = np.linspace(0.0, 0.1, 6)
    patch = np.stack(np.meshgrid(steps, steps, [0.0]), axis=-1).reshape(-1, 3)
    wavy = patch + 0.01 * np.sin(40.0 * patch[:, ::-1])
    # First what a first page may wait for: the compiled engine leaves some registrations to Open3D.
    engine.align(wavy, wavy + 0.003, 0.1)
    engine.labels(np.vstack([wavy, wavy + 2.0]), 5, None, False)
