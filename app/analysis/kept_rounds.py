"""Rounds of all pairs of a recording, from which surveys with other thresholds are made at once."""

import threading
from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import islice

import numpy as np
from numpy.typing import NDArray

from app.analysis.pairs import Pair
from app.analysis.survey import Survey
from estimator import Label, Parameters, find_method
from estimator.flow import ClusterResult, Indices, without
from estimator.metrics import means_of
from estimator.outcomes import States, joined, left_in_states, outcomes, states_of
from estimator.paper import ALGORITHM_1
from estimator.point_errors import ERRORS, lengths, point_errors, sums_of_groups
from estimator.rounds import displaced
from recordings import Recording

MOST = 2048
"""Pairs of which rounds are kept, some 10 kB each."""


def without_thresholds(parameters: Parameters) -> Parameters | None:
    """What the rounds depend on; None for a method that does not have these thresholds."""
    if find_method(parameters.method) is not ALGORITHM_1:
        return None
    default = Parameters()
    return replace(parameters, gamma=default.gamma, delta=default.delta, n_min=default.n_min)


@dataclass(frozen=True)
class _Kept:
    """Sums and numbers of values (as by `sums_of_groups`) of parts of a pair, or of several.

    Columns are the speed and `ERRORS`.

    Attributes:
        states: of the clusters.
        moving: (S, W) of the points that are left in a state, as the round that follows moves them.
        removed: (S, W) of the points that are not left any more.
        resting: (C, W) of all points of a cluster, without a flow.
        others: (P, W) of the points of no cluster.
        clusters: (P,) number of clusters.
    """

    states: States
    moving: NDArray[np.float64]
    removed: NDArray[np.float64]
    resting: NDArray[np.float64]
    others: NDArray[np.float64]
    clusters: NDArray[np.intp]


class KeptRounds:
    """Rounds of the pairs of a recording; thread-safe.

    Args:
        recording: of the pairs.
        parameters: of `without_thresholds`.
    """

    def __init__(self, recording: Recording, parameters: Parameters) -> None:
        self._lock = threading.Lock()
        self._facts = Survey(recording, parameters)
        self._pairs: dict[int, _Kept] = {}
        self._left_out: set[int] = set()
        self._joined: tuple[NDArray[np.intp], _Kept] | None = None

    def __len__(self) -> int:
        return len(self._facts)

    def wants(self, k: int) -> bool:
        """Whether the rounds of a frame's pair are missing, and there is room for them."""
        known = k in self._pairs or k in self._left_out
        return not known and len(self._pairs) < MOST

    def missing(self) -> list[int]:
        """Frames whose rounds are wanted, no more than there is room for."""
        room = MOST - len(self._pairs)
        if room <= 0:
            return []
        frames = range(self._facts.parameters.n, len(self._facts))
        return list(islice((k for k in frames if self.wants(k)), room))

    def leave_out(self, k: int) -> None:
        """Want the rounds of a broken frame's pair no more."""
        self._left_out.add(k)

    def put(self, pair: Pair, clusters: Sequence[ClusterResult], survey: Survey) -> None:
        """Keep the rounds of an estimated pair.

        Args:
            pair: with a flow.
            clusters: of `all_rounds`.
            survey: with any thresholds, in which the pair is stored.
        """
        kept = _kept(pair, clusters)
        with self._lock:
            self._facts.copy_facts(survey, np.array([pair.frame]))
            self._pairs[pair.frame] = kept
            self._joined = None

    def fill(self, survey: Survey) -> None:
        """Store in a survey what is known of the pairs that are kept, as estimates would give."""
        with self._lock:
            if not self._pairs:
                return
            if self._joined is None:
                self._joined = np.array(list(self._pairs)), _join(list(self._pairs.values()))
            frames, kept = self._joined
        end, label = outcomes(kept.states, survey.parameters)
        pair_of = np.repeat(np.arange(len(frames)), kept.clusters)
        whole, left = kept.states.source_size[kept.states.first], kept.states.source_size[end]
        moves = label == Label.MOVING
        stationary = np.where(label == Label.STATIONARY, whole, whole - left)
        sums = _sums(kept, end, moves, pair_of)
        survey.copy_facts(self._facts, frames)
        survey.put_flows(
            frames,
            _total(np.where(moves, left, 0), pair_of, len(frames)),
            _total(stationary, pair_of, len(frames)),
            means_of(sums)[:, 0],
            sums[:, 2:],
        )


def _total(values: NDArray[np.int64], pair_of: NDArray[np.intp], pairs: int) -> NDArray[np.int64]:
    return np.asarray(np.bincount(pair_of, values, pairs)).astype(np.int64)


def _sums(
    kept: _Kept, end: NDArray[np.intp], moves: NDArray[np.bool_], pair_of: NDArray[np.intp]
) -> NDArray[np.float64]:
    """Sums (P, W) over whole pairs, in the order in which `flow_sums` takes their parts."""
    pairs = len(kept.others)
    without_flow = np.where(moves[:, None], kept.removed[end], kept.resting)
    with_flow = np.where(moves[:, None], kept.moving[end], 0.0)
    of_clusters = np.stack([without_flow, with_flow], axis=1).reshape(-1, kept.others.shape[1])
    parts = np.concatenate([kept.others, of_clusters])
    of_part = np.concatenate([np.arange(pairs), np.repeat(pair_of, 2)])
    sums = np.zeros_like(kept.others)
    for at, column in enumerate(parts.T):
        sums[:, at] = np.bincount(of_part, column, pairs)  # which adds one part after the other
    return sums


def _join(pairs: Sequence[_Kept]) -> _Kept:
    def all_of(name: str) -> NDArray[np.float64]:
        return np.concatenate([getattr(pair, name) for pair in pairs])

    return _Kept(
        states=joined([pair.states for pair in pairs]),
        moving=all_of("moving"),
        removed=all_of("removed"),
        resting=all_of("resting"),
        others=all_of("others"),
        clusters=np.concatenate([pair.clusters for pair in pairs]),
    )


def _kept(pair: Pair, clusters: Sequence[ClusterResult]) -> _Kept:
    assert pair.flow is not None
    assert pair.source is not None
    states = states_of(clusters)
    left, removed, velocities, numbers = [], [], [], []
    for cluster, first in zip(clusters, states.first.tolist(), strict=True):
        # The last state has no round, and its points no flow.
        for number, (each, points) in enumerate(
            zip(cluster.rounds, left_in_states(cluster), strict=False), start=first
        ):
            numbers.append(number)
            left.append(points)
            removed.append(without(cluster.source, points))
            moved = displaced(pair.source.points[points], each.transformation)
            velocities.append(moved / pair.interval)
    size = len(states.fitness)
    without_flow = _values(pair, np.arange(len(pair.flow.cluster)))
    others, resting = np.split(
        sums_of_groups(without_flow, pair.flow.cluster + 1, len(clusters) + 1), [1]
    )
    with_flow = _values(pair, _concatenated(left), np.concatenate([np.empty((0, 3)), *velocities]))
    return _Kept(
        states=states,
        moving=sums_of_groups(with_flow, _repeated(numbers, left), size),
        removed=sums_of_groups(
            without_flow[_concatenated(removed)], _repeated(numbers, removed), size
        ),
        resting=resting,
        others=others,
        clusters=np.array([len(clusters)]),
    )


def _concatenated(parts: Sequence[Indices]) -> Indices:
    return np.concatenate([np.empty(0, dtype=np.intp), *parts])


def _repeated(numbers: Sequence[int], parts: Sequence[Indices]) -> Indices:
    """The number of each part, for each of its points."""
    return np.repeat(np.array(numbers, dtype=np.intp), [len(part) for part in parts])


def _values(
    pair: Pair, points: Indices, velocity: NDArray[np.float64] | None = None
) -> NDArray[np.float64]:
    """Speed and errors (N, W / 2) of source points that move with a velocity, or have no flow."""
    values = np.full((len(points), 1 + len(ERRORS)), np.nan)
    moving = np.full(len(points), velocity is not None)
    if velocity is None:
        velocity = np.full((len(points), 3), np.nan)
    values[:, 0] = lengths(velocity)
    if pair.truth is not None:
        of_points = None if pair.truth.points is None else pair.truth.points[points]
        of_object = pair.truth.velocity[points]
        values[:, 1:] = point_errors(moving, velocity, pair.interval, of_object, of_points)
    return values
