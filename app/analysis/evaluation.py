"""Errors of methods over a whole recording, against its truth."""

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field, replace
from itertools import groupby
from time import thread_time

from app.analysis.pair_estimator import PairEstimator
from app.analysis.pairs import PreparedPair, moves, prepare_pair
from estimator import Metrics, Parameters, PooledErrors
from recordings import Recording, RecordingError


@dataclass(frozen=True)
class EvaluationCase:
    """One set of parameters to evaluate a recording with.

    Attributes:
        parameters: of the estimates, method included.
        resting: whether pairs that do not count are estimated too. Only `false_flow` needs them,
            and is NaN without them; leaving them out saves time where the object rests long.
    """

    parameters: Parameters
    resting: bool = True


@dataclass(frozen=True)
class Evaluation:
    """Errors with one set of parameters.

    Attributes:
        metrics: pooled over the recording, None without truth.
        seconds: CPU time of one core; stages shared by several cases count for the first.
    """

    metrics: Metrics | None
    seconds: float


@dataclass
class _Running:
    """State of an evaluation that is running."""

    case: EvaluationCase
    estimator: PairEstimator
    errors: PooledErrors = field(default_factory=PooledErrors)
    seconds: float = 0.0


def evaluate(recording: Recording, parameters: Parameters) -> Metrics | None:
    """Estimate every pair with truth and pool the errors; None for a recording without truth.

    Raises:
        RecordingError: the file is broken at a pair that counts.
    """
    return evaluate_all(recording, [EvaluationCase(parameters)])[0].metrics


def evaluate_all(recording: Recording, cases: Sequence[EvaluationCase]) -> list[Evaluation]:
    """Evaluate several cases; stages of a pair that they share are computed once.

    Broken frames are skipped in pairs that do not count.

    Args:
        recording: to evaluate.
        cases: in any order.

    Returns:
        An evaluation for each case, in their order.

    Raises:
        RecordingError: the file is broken at a pair that counts.
    """
    if not recording.has_truth:
        return [Evaluation(None, 0.0) for _ in cases]
    found: dict[EvaluationCase, Evaluation] = {}
    in_groups = sorted(cases, key=_window_settings)
    for _, group in groupby(in_groups, key=_window_settings):
        found |= _evaluate_together(recording, list(dict.fromkeys(group)))
    return [found[case] for case in cases]


def counting_pairs(recording: Recording, n: int) -> Iterator[tuple[int, int]]:
    """Pairs (k-n, k) that count: the object moves at both frames."""
    moving = [moves(recording, k) for k in range(len(recording))]
    for k in range(n, len(recording)):
        if moving[k - n] and moving[k]:
            yield k - n, k


def _window_settings(case: EvaluationCase) -> tuple[int, float]:
    """Parameters that determine the windows of a recording."""
    return case.parameters.n, case.parameters.max_range


def _evaluate_together(
    recording: Recording, cases: Sequence[EvaluationCase]
) -> dict[EvaluationCase, Evaluation]:
    """Evaluate cases with equal windows, each of which is loaded once."""
    parameters = cases[0].parameters
    windows = _LastPrepared(recording, parameters)
    running = [_Running(case, PairEstimator(case.parameters)) for case in cases]
    counting = {k for _, k in counting_pairs(recording, parameters.n)}
    for k in range(parameters.n, len(recording)):
        wanted = [run for run in running if k in counting or run.case.resting]
        for run in wanted:
            begin = thread_time()
            try:
                _include(run, windows, k, counts=k in counting)
            except RecordingError:
                # A frame broken while nothing moves does not affect the errors.
                if k in counting:
                    raise
            run.seconds += thread_time() - begin
    return {run.case: _finished(run) for run in running}


def _include(run: _Running, windows: "_LastPrepared", k: int, *, counts: bool) -> None:
    truth = windows.at(k).pair.truth
    if truth is None or not (counts or truth.points is not None):
        return
    errors = run.estimator.pair(k, windows.at).pooled_errors(counts=counts)
    assert errors is not None
    run.errors.include(errors.sums)


def _finished(run: _Running) -> Evaluation:
    metrics = run.errors.metrics()
    if not run.case.resting:
        metrics = replace(metrics, false_flow=math.nan)
    return Evaluation(metrics, run.seconds)


class _LastPrepared:
    """Pairs of a recording, with a cache of the last one."""

    def __init__(self, recording: Recording, parameters: Parameters) -> None:
        self._recording, self._parameters = recording, parameters
        self._last: PreparedPair | None = None

    def at(self, k: int) -> PreparedPair:
        """The pair of frame `k`."""
        if self._last is None or self._last.pair.frame != k:
            self._last = prepare_pair(self._recording, k, self._parameters)
        return self._last
