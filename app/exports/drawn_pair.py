"""Pairs with everything else that a drawing of them shows."""

from collections.abc import Mapping
from dataclasses import dataclass

from app.analysis.comparison import A, Comparison
from app.analysis.estimates import Estimates
from app.analysis.library import Opened
from app.analysis.pairs import Pair
from app.analysis.selection import Selection, cluster_of
from app.scene.flow_colours import speed_limit
from app.scene.legend import Legend, legend
from app.scene.settings import ViewSettings
from estimator import ClusterResult, Parameters


@dataclass(frozen=True)
class DrawnPair:
    """A pair as the scene draws it.

    Attributes:
        pair: with its flow.
        parameters: of its estimate.
        comparison: with other parameters, None without one.
        second: pair of the same frame with those, None unless its flow is drawn too.
        picked: the picked cluster of the pair, None for none.
    """

    pair: Pair
    parameters: Parameters
    comparison: Comparison | None = None
    second: Pair | None = None
    picked: ClusterResult | None = None

    @property
    def side(self) -> str:
        """A or B, the side of `pair`."""
        return self.comparison.edited if self.comparison else A

    @property
    def sides(self) -> Mapping[str, Parameters]:
        """{A or B: its parameters} where the flow of both is drawn, else empty."""
        return self.comparison.drawn(self.parameters) if self.comparison else {}

    def legend(self, settings: ViewSettings) -> Legend:
        """Legend of its drawing."""
        side = None if self.second is None else self.side
        limit = speed_limit(self.pair, 0.0)
        return legend(self.pair, settings, limit, side, self.picked, self.second)


class DrawnPairs:
    """Estimates pairs as the scene draws them, one frame after the other.

    Args:
        opened: the recording.
        parameters: of the estimates.
        estimates: computes and caches flows.
        comparison: with other parameters, whose flow is drawn too if its `both` is set.
        picked: pair and index of a picked cluster, which is followed; None for none.
    """

    def __init__(
        self,
        opened: Opened,
        parameters: Parameters,
        estimates: Estimates,
        comparison: Comparison | None = None,
        picked: tuple[Pair, int] | None = None,
    ) -> None:
        self.opened, self.parameters = opened, parameters
        self.comparison = comparison
        self._estimates = estimates
        self._selection = Selection()
        if picked is not None:
            self._selection.pick(*picked)

    def at(self, frame: int) -> DrawnPair:
        """The pair of a frame k.

        Raises:
            RecordingError: the recording is broken there.
        """
        pair = self._estimated(frame, self.parameters)
        second = None
        if self.comparison is not None and self.comparison.both:
            second = self._estimated(frame, self.comparison.other)
        picked = cluster_of(pair, self._selection.follow(pair))
        return DrawnPair(pair, self.parameters, self.comparison, second, picked)

    def _estimated(self, frame: int, parameters: Parameters) -> Pair:
        return self._estimates.estimated_in_background(self.opened, frame, parameters)
