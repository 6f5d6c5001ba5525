"""Pairs that a session estimates and draws, and the cluster that is picked in them."""

from app.analysis.comparison import A, Comparison, estimate_frame
from app.analysis.estimates import Estimates
from app.analysis.library import Opened
from app.analysis.pairs import Pair
from app.analysis.selection import Selection, cluster_of
from app.scene.canvas import Canvas
from app.scene.framing import Framing
from app.scene.scene import Scene
from estimator import Engine, Parameters, current_engine


class Drawing:
    """Draws a frame's pair, and the one with the other parameters of a comparison.

    Args:
        client: the browser client.
        estimates: computes and caches flows.
        scene: in the client's browser.
        framing: moves the scene's camera to views.

    Attributes:
        pair: that is drawn, None without one.
        other: the pair with the other parameters, None unless estimated.
        picked: index of the picked cluster in the pair's flow, None without one.
    """

    def __init__(
        self, client: Canvas, estimates: Estimates, scene: Scene, framing: Framing
    ) -> None:
        self._client, self._estimates = client, estimates
        self._scene, self._framing = scene, framing
        self._drawn: tuple[Opened, int, Parameters, Comparison | None, Engine] | None = None
        self._selection = Selection()
        self.pair: Pair | None = None
        self.other: Pair | None = None
        self.picked: int | None = None

    def draw(
        self, opened: Opened, frame: int, parameters: Parameters, comparison: Comparison | None
    ) -> None:
        """Estimate and draw a frame, unless it is drawn already.

        Raises:
            UserError: the other pair of the comparison could not be estimated; this one is drawn.
        """
        wanted = (opened, frame, parameters, comparison, current_engine())
        if wanted == self._drawn:
            return
        self.pair = self.other = None
        found = estimate_frame(self._estimates, opened, frame, parameters, comparison)
        self.pair, self.other = found.pair, found.other
        with self._client.atomic():
            self.picked = self._selection.follow(found.pair)
            self._scene.show(
                found.pair,
                found.second,
                comparison.edited if comparison else A,
                cluster_of(found.pair, self.picked),
            )
            if self._drawn is None or self._drawn[0] is not opened:
                self._framing.begin(found.pair)
            else:
                self._framing.retry_first_view(found.pair)
        self._client.flush()  # the panels follow by themselves
        self._drawn = wanted
        if found.problem is not None:
            raise found.problem

    def pick(self, cluster: int | None) -> None:
        """Pick the cluster with this index, or none."""
        if self.pair is not None:
            self._selection.pick(self.pair, cluster)
            self.picked = self._selection.follow(self.pair)
            self._scene.mark(self.pair, cluster_of(self.pair, self.picked))

    def await_cluster(self, index: int | None) -> None:
        """Pick the cluster with this index in the next pair that has a flow."""
        self._selection.await_cluster(index)

    def drop(self) -> None:
        """Pick none, since another recording is opened."""
        self._selection.drop()
