"""Two sets of parameters, A and B, of which one is edited."""

from dataclasses import dataclass
from typing import TypeVar

from app.analysis.estimates import Estimates
from app.analysis.library import Opened
from app.analysis.pairs import Pair
from estimator import Parameters

T = TypeVar("T")

A, B = "A", "B"
"""Names of two sets of parameters that are compared."""


@dataclass(frozen=True)
class Comparison:
    """What a session knows of A and B beyond the parameters that are edited.

    Attributes:
        other: the parameters that are not edited.
        edited: A or B.
        both: whether the flow of the other is drawn too, and estimated for it.
    """

    other: Parameters
    edited: str = A
    both: bool = False

    def switched(self, edited: Parameters) -> "Comparison":
        """The other one edited, instead of the one that is `edited` now."""
        return Comparison(edited, B if self.edited == A else A, self.both)

    def drawn(self, edited: Parameters) -> dict[str, Parameters]:
        """{A or B: its parameters} where the flow of both is drawn, else nothing."""
        of_a, of_b = self.in_order(edited, self.other)
        return {A: of_a, B: of_b} if self.both else {}

    def in_order(self, edited: T, other: T) -> tuple[T, T]:
        """What belongs to A, and what belongs to B."""
        return (edited, other) if self.edited == A else (other, edited)


@dataclass(frozen=True)
class FrameEstimate:
    """One frame with the edited parameters, and with the other ones.

    Attributes:
        pair: with the edited parameters.
        other: with the other ones, None unless its estimate is wanted or known.
        second: the other pair where its flow is drawn too.
        problem: what went wrong in an estimate; its pair has no flow then.
    """

    pair: Pair
    other: Pair | None
    second: Pair | None
    problem: Exception | None


def estimate_frame(
    estimates: Estimates,
    opened: Opened,
    frame: int,
    parameters: Parameters,
    comparison: Comparison | None,
) -> FrameEstimate:
    """Estimate what is shown of a frame; what is not shown is looked up, not estimated."""
    pair, problem = _estimated(estimates, opened, frame, parameters)
    if comparison is None:
        return FrameEstimate(pair, None, None, problem)
    if not comparison.both:
        known = estimates.known(opened, frame, comparison.other)
        return FrameEstimate(pair, known, None, problem)
    other, failed = _estimated(estimates, opened, frame, comparison.other)
    return FrameEstimate(pair, other, other, problem or failed)


def _estimated(
    estimates: Estimates, opened: Opened, frame: int, parameters: Parameters
) -> tuple[Pair, Exception | None]:
    """A pair; without its flow where the estimator fails on it, and what went wrong."""
    try:
        return estimates.estimated(opened, frame, parameters), None
    except Exception as error:
        return estimates.pair(opened, frame, parameters), error
