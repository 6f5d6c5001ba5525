"""Result of an estimate: a label and a velocity per source point, and a result per cluster."""

from collections.abc import Sequence
from dataclasses import dataclass
from enum import IntEnum

import numpy as np
from numpy.typing import NDArray

Indices = NDArray[np.intp]


class Label(IntEnum):
    """Label of a source point or of a cluster."""

    UNASSIGNED = 0
    STATIONARY = 1
    MOVING = 2


class ReadOnlyArrays:
    """Base of dataclasses whose arrays cannot be written to: threads and sessions share them."""

    def __post_init__(self) -> None:
        for value in vars(self).values():
            if isinstance(value, np.ndarray):
                value.setflags(write=False)


@dataclass(frozen=True)
class Cluster(ReadOnlyArrays):
    """A cluster of the merged cloud.

    Attributes:
        index: its number, from 0.
        source: indices of its points in the source, P_{k-n}^C.
        target: indices of its points in the target, P_k^C.
    """

    index: int
    source: Indices
    target: Indices


@dataclass(frozen=True)
class IcpRound(ReadOnlyArrays):
    """One iteration of Algorithm 1's loop over a cluster.

    Attributes:
        source_size: number of source points given to ICP.
        target_size: number of target points given to ICP.
        fitness: inlier correspondences / source points.
        inlier_rmse: root mean square distance of the inliers, metres.
        transformation: (4, 4), takes source points onto the target.
        mean_displacement: mean distance that it moves the source points, metres.
        inlier_source: indices into the source of the corresponding points.
        inlier_target: indices into the target of the corresponding points.
    """

    source_size: int
    target_size: int
    fitness: float
    inlier_rmse: float
    transformation: NDArray[np.float64]
    mean_displacement: float
    inlier_source: Indices
    inlier_target: Indices


@dataclass(frozen=True)
class StoryRow:
    """Row of a method's own explanation of a cluster, shown unchanged.

    Attributes:
        name: of the quantity.
        value: a number or a text.
        unit: "" where there is none.
        threshold: number that the value was compared with, None where there is none.
    """

    name: str
    value: float | str
    unit: str = ""
    threshold: float | None = None


@dataclass(frozen=True)
class ClusterResult(ReadOnlyArrays):
    """Result of one cluster, with the reason for it.

    Attributes:
        index: the cluster's number, as in `SceneFlow.cluster`.
        source: indices of all its source points.
        target: indices of all its target points.
        remaining: indices of the source points left after the last removal; `label` is theirs.
        rounds: every ICP round in order, empty where the cluster was skipped at once. The inliers
            of a round left the cluster wherever another round follows or the label is UNASSIGNED.
        label: of the remaining points. Removed inliers are stationary.
        velocity: (len(remaining), 3) m/s, NaN where `label` is not MOVING.
        reason: why it has this label, in words.
        story: further rows of the method's explanation.
    """

    index: int
    source: Indices
    target: Indices
    remaining: Indices
    rounds: tuple[IcpRound, ...]
    label: Label
    velocity: NDArray[np.float64]
    reason: str
    story: tuple[StoryRow, ...] = ()

    @property
    def fitness(self) -> float:
        """Fitness of the last round, NaN where there was none."""
        return self.rounds[-1].fitness if self.rounds else float("nan")

    @property
    def mean_displacement(self) -> float:
        """Mean displacement of the last round in metres, NaN where there was none."""
        return self.rounds[-1].mean_displacement if self.rounds else float("nan")

    @property
    def removed(self) -> Indices:
        """Indices of the source points that were removed as inliers."""
        return without(self.source, self.remaining)


@dataclass(frozen=True)
class SceneFlow(ReadOnlyArrays):
    """The flow of one pair.

    Attributes:
        label: (N,) `Label` of each source point.
        velocity: (N, 3) m/s in the clouds' frame, NaN where the label is not MOVING.
        cluster: (N,) cluster index of each source point, -1 for none.
        clusters: a result per cluster, in the order of their indices; arrays are read-only.
    """

    label: NDArray[np.int64]
    velocity: NDArray[np.float64]
    cluster: NDArray[np.int64]
    clusters: tuple[ClusterResult, ...]

    @property
    def moving(self) -> NDArray[np.bool_]:
        """(N,) whether a source point has a flow."""
        return self.label == Label.MOVING


def without(indices: Indices, removed: Indices) -> Indices:
    """Ascending indices less those that are removed, which are among them."""
    kept = np.zeros(indices[-1] + 1 if len(indices) else 0, dtype=np.bool_)
    kept[indices] = True
    kept[removed] = False
    return np.flatnonzero(kept)


def cluster_result(
    cluster: Cluster,
    remaining: Indices,
    rounds: list[IcpRound],
    label: Label,
    reason: str,
    velocity: NDArray[np.float64] | None = None,
    story: Sequence[StoryRow] = (),
) -> ClusterResult:
    """Make the result of a cluster; `velocity` (len(remaining), 3) m/s where it moves."""
    return ClusterResult(
        index=cluster.index,
        source=cluster.source,
        target=cluster.target,
        remaining=remaining,
        rounds=tuple(rounds),
        label=label,
        velocity=np.full((len(remaining), 3), np.nan) if velocity is None else velocity,
        reason=f"{label.name.capitalize()}: {reason}.",
        story=tuple(story),
    )


def scene_flow(source_size: int, clusters: Sequence[ClusterResult]) -> SceneFlow:
    """Combine the clusters' results into labels and velocities of `source_size` points."""
    label = np.full(source_size, Label.UNASSIGNED, dtype=np.int64)
    velocity = np.full((source_size, 3), np.nan)
    cluster = np.full(source_size, -1, dtype=np.int64)
    for result in clusters:
        cluster[result.source] = result.index
        label[result.removed] = Label.STATIONARY
        label[result.remaining] = result.label
        velocity[result.remaining] = result.velocity
    return SceneFlow(label, velocity, cluster, tuple(clusters))


def scene_flow_of_points(
    velocity: NDArray[np.float64], cluster: NDArray[np.int64] | None = None
) -> SceneFlow:
    """Make a scene flow from velocities of single points.

    Args:
        velocity: (N, 3) m/s of each source point that moves, NaN for one that does not.
        cluster: (N,) index of each point's cluster, -1 for none; None: no point has one.
    """
    moving = np.asarray(np.isfinite(velocity).all(axis=1))
    label = np.where(moving, Label.MOVING, Label.STATIONARY).astype(np.int64)
    if cluster is None:
        cluster = np.full(len(velocity), -1, dtype=np.int64)
    return SceneFlow(label, np.where(moving[:, None], velocity, np.nan), cluster, ())
