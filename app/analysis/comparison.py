"""Two sets of parameters, A and B, of which one is edited."""

from dataclasses import dataclass
from typing import TypeVar

from app.analysis.estimates import Estimates
from app.analysis.library import Opened
from app.analysis.pairs import Pair
from estimator import Parameters

T = TypeVar("T")

A, B = "A", "B"
"""Names of the two sets of parameters."""


@dataclass(frozen=True)
class Comparison:
    """Comparison of the edited parameters with a second set.

    Attributes:
        other: the parameters that are not edited.
        edited: A or B.
        both: whether the flow of the other set is estimated and drawn too.
    """

    other: Parameters
    edited: str = A
    both: bool = False

    def switched(self, edited: Parameters) -> "Comparison":
        """The comparison with the sides swapped, given the parameters edited so far."""
        return Comparison(edited, B if self.edited == A else A, self.both)

    def drawn(self, edited: Parameters) -> dict[str, Parameters]:
        """{A or B: its parameters} where the flow of both is drawn, else empty."""
        of_a, of_b = self.in_order(edited, self.other)
        return {A: of_a, B: of_b} if self.both else {}

    def in_order(self, edited: T, other: T) -> tuple[T, T]:
        """The values of the edited and the other side, as (of A, of B)."""
        return (edited, other) if self.edited == A else (other, edited)


def by_side(comparison: Comparison | None, edited: T, other: T) -> dict[str, T]:
    """{A or B: its value} of what belongs to the edited and the other side, A alone without a B."""
    if comparison is None:
        return {A: edited}
    return dict(zip((A, B), comparison.in_order(edited, other), strict=True))


@dataclass(frozen=True)
class FrameEstimate:
    """Pairs of one frame, with the edited and with the other parameters.

    Attributes:
        pair: with the edited parameters.
        other: with the other ones, None unless it is drawn or already estimated.
        second: the other pair if its flow is drawn too, else None.
        problem: error of an estimate, whose pair then has no flow; None without one.
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
    """Estimate the pairs of a frame that are drawn; the other pair is only looked up."""
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
    """The pair and None, or the pair without flow and the estimator's error."""
    try:
        return estimates.estimated(opened, frame, parameters), None
    except Exception as error:
        return estimates.pair(opened, frame, parameters), error
