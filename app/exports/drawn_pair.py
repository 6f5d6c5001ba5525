"""Pair with everything else that a drawing of it shows."""

from dataclasses import dataclass

from app.analysis.comparison import A
from app.analysis.pairs import Pair
from estimator import ClusterResult


@dataclass(frozen=True)
class DrawnPair:
    """A pair as the scene draws it.

    Attributes:
        pair: with its flow.
        second: pair of the same frame whose flow is drawn too, None for none.
        side: A or B, the side of `pair` where both are drawn.
        picked: the picked cluster of the pair, None for none.
    """

    pair: Pair
    second: Pair | None = None
    side: str = A
    picked: ClusterResult | None = None
