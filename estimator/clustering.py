"""Lines 1-4 of Algorithm 1: merge the clouds, cluster them, split each cluster again."""

import numpy as np

from estimator.engines import Engine, current_engine
from estimator.flow import Cluster
from estimator.parameters import Parameters
from estimator.window import Window


def clusters_of(window: Window, parameters: Parameters) -> tuple[Cluster, ...]:
    """Cluster the merged clouds with HDBSCAN; the result is cached per setting.

    The target's points come first in the merged cloud: HDBSCAN breaks ties by the order of the
    points, so it is fixed. Points that are not finite belong to no cluster. With fewer points than
    HDBSCAN needs there is no cluster.
    """
    engine = current_engine()
    settings = (
        engine.name,
        parameters.min_cluster_size,
        parameters.min_samples,
        parameters.allow_single_cluster,
    )
    return window.stages.get(("clusters", settings), lambda: _clusters(window, parameters, engine))


def _clusters(window: Window, parameters: Parameters, engine: Engine) -> tuple[Cluster, ...]:
    source, target = window.source.points, window.target.points
    finite_target = np.flatnonzero(np.isfinite(target).all(axis=1))
    finite_source = np.flatnonzero(np.isfinite(source).all(axis=1))
    merged = np.vstack([target[finite_target], source[finite_source]])
    if len(merged) < max(parameters.min_cluster_size, parameters.min_samples or 1, 2):
        return ()
    labels = engine.labels(
        merged,
        parameters.min_cluster_size,
        parameters.min_samples,
        parameters.allow_single_cluster,
    )
    labels_target, labels_source = np.split(labels, [len(finite_target)])
    return tuple(
        Cluster(
            index,
            source=finite_source[labels_source == index],
            target=finite_target[labels_target == index],
        )
        for index in range(labels.max() + 1)
    )
