"""What Algorithm 1 decides with any thresholds, from rounds that were computed before.

Which points a round takes away does not depend on γ, δ or N_min. They decide after which round the
loop of a cluster ends, and with which label; `estimator/paper.py` is the loop itself.
"""

from collections.abc import Sequence
from dataclasses import dataclass, fields, replace

import numpy as np
from numpy.typing import NDArray

from estimator.flow import ClusterResult, Indices, Label, ReadOnlyArrays, without
from estimator.paper import algorithm_1
from estimator.parameters import Parameters
from estimator.window import Window


def all_rounds(window: Window, parameters: Parameters) -> tuple[ClusterResult, ...]:
    """Clusters of a window with every round that Algorithm 1 could come to.

    No fitness is above a γ of 1, so that a loop ends only where nothing is left to be matched.
    """
    return algorithm_1(window, replace(parameters, gamma=1.0, n_min=1)).clusters


def left_in_states(cluster: ClusterResult) -> list[Indices]:
    """Source points of a cluster that are left before each of its rounds, and after the last."""
    left = [cluster.source]
    for each in cluster.rounds:
        left.append(without(left[-1], each.inlier_source))
    return left


@dataclass(frozen=True)
class States(ReadOnlyArrays):
    """States of clusters, before each of their rounds and after the last one; flat arrays.

    Attributes:
        first: (C,) number of each cluster's first state; the others follow.
        source_size: (S,) source points that are left.
        target_size: (S,) target points that are left.
        fitness: (S,) of the round that follows, NaN after the last one.
        mean_displacement: (S,) of that round, metres, likewise.
    """

    first: NDArray[np.intp]
    source_size: NDArray[np.int64]
    target_size: NDArray[np.int64]
    fitness: NDArray[np.float64]
    mean_displacement: NDArray[np.float64]


def states_of(clusters: Sequence[ClusterResult]) -> States:
    """States of the clusters of `all_rounds`."""
    first: list[int] = []
    rows: list[tuple[float, ...]] = []
    for cluster in clusters:
        first.append(len(rows))
        source_size, target_size = len(cluster.source), len(cluster.target)
        for each in cluster.rounds:
            rows.append((source_size, target_size, each.fitness, each.mean_displacement))
            source_size -= len(each.inlier_source)
            target_size -= len(np.unique(each.inlier_target))
        rows.append((source_size, target_size, np.nan, np.nan))
    source, target, fitness, mean_displacement = np.array(rows, dtype=np.float64).reshape(-1, 4).T
    return States(
        first=np.array(first, dtype=np.intp),
        source_size=source.astype(np.int64),
        target_size=target.astype(np.int64),
        fitness=fitness,
        mean_displacement=mean_displacement,
    )


def joined(parts: Sequence[States]) -> States:
    """States of the clusters of one window or more, in order."""
    begins = np.cumsum([0, *(len(part.fitness) for part in parts[:-1])])
    first = [part.first + begin for part, begin in zip(parts, begins, strict=True)]
    others = [field.name for field in fields(States) if field.name != "first"]
    return States(
        first=np.concatenate(first),
        **{name: np.concatenate([getattr(part, name) for part in parts]) for name in others},
    )


def outcomes(states: States, parameters: Parameters) -> tuple[NDArray[np.intp], NDArray[np.int64]]:
    """Decide for every cluster as lines 4-22 of Algorithm 1 do.

    Returns:
        The state in which each cluster's loop ends (C,), and the label of what is left then (C,).
    """
    few = (states.source_size < parameters.n_min) & (states.target_size < parameters.n_min)
    matched = ~few & (states.fitness > parameters.gamma)
    moved = matched & ~(states.mean_displacement < parameters.delta)
    # A round that pairs nothing has a fitness of zero, and is the last one.
    ends = few | matched | ~(states.fitness > 0)
    # From each cluster's first state on, the next one that ends; a cluster's last state does.
    ending = np.flatnonzero(ends)
    end = ending[np.searchsorted(ending, states.first)]
    label = np.where(moved, Label.MOVING, np.where(matched, Label.STATIONARY, Label.UNASSIGNED))
    return end, label[end]
