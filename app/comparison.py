"""Two sets of parameters, A and B, of which one is edited."""

from dataclasses import dataclass
from typing import TypeVar

from estimator import Parameters

T = TypeVar("T")

A, B = "A", "B"


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

    def in_order(self, edited: T, other: T) -> tuple[T, T]:
        """What belongs to A, and what belongs to B."""
        return (edited, other) if self.edited == A else (other, edited)
