"""Explanation of a pair: all clusters' outcomes, the picked one's story, histograms."""

import reprlib
from collections.abc import Sequence
from dataclasses import dataclass

import viser

from app.analysis.pairs import Pair
from app.analysis.selection import cluster_of
from app.browser.assets import call, run_asset
from app.browser.controls import show_value
from app.browser.fields import sets
from app.panels.cluster_story import cluster_table, legend, story, telling_round
from app.panels.histograms import Histogram, upper_limit
from app.panels.panel import Panel, PanelContext
from app.panels.save_clusters import add_save_button
from app.panels.tables import framed
from app.scene.palettes import Palette
from app.session.command import Command, LatestWins
from app.session.commands import Refuse
from app.session.snapshot import Snapshot
from app.session.workbench import Workbench
from estimator import ClusterResult, Parameters

_NONE: str = "none"
_STEP = 0.05  # width of a bar of the fitness
_BARS = 20  # of the displacement

Vector = tuple[float, float, float]


@dataclass(frozen=True)
class PickCluster(LatestWins):
    """Pick the cluster with this index, or none."""

    index: int | None

    def apply(self, workbench: Workbench) -> None:
        """Pick it."""
        workbench.pick(self.index)


@dataclass(frozen=True)
class PickAt(LatestWins):
    """Pick the cluster under a click in the scene; a click beside all of them picks none."""

    origin: Vector
    direction: Vector

    def apply(self, workbench: Workbench) -> None:
        """Pick the cluster under the ray."""
        workbench.pick_at(self.origin, self.direction)


class ExplainPanel(Panel):
    """List of clusters to pick from, and the picked cluster's story."""

    def __init__(self, context: PanelContext) -> None:
        gui, post = context.client.gui, context.post
        self._pair: Pair | None = None
        self._shown: tuple[int | None, Palette] | None = None
        self._client = context.client
        run_asset(self._client, "story.js")
        self._list = gui.add_dropdown(
            "Cluster",
            (_NONE,),
            hint="Or click on its row below, or on one of its points in the scene.",
        )
        self._table = gui.add_html("")
        self._story = gui.add_html("")
        self._fitness = gui.add_html("")
        self._displacement = gui.add_html("")
        add_save_button(context)

        @self._list.on_update
        async def _(event: viser.GuiEvent) -> None:
            if event.client_id is not None:
                post(_pick(self._list.value))

        # viser does not report drags, which turn the camera, as clicks.
        @context.client.scene.on_click()
        def _(event: viser.SceneClickEvent) -> None:
            post(PickAt(event.ray_origin, event.ray_direction))

    def show(self, snapshot: Snapshot) -> None:
        """Show the clusters of the pair, and the picked one's story."""
        pair = snapshot.pair
        if pair is None or pair.flow is None:
            self._pair = None
            self._choices({_NONE: None}, None)
            self._story.content = framed("There is no estimate of this frame to explain.")
            self._table.content = self._fitness.content = self._displacement.content = ""
            return
        picked, palette = shown = (snapshot.picked, snapshot.settings.palette)
        if pair is not self._pair or shown != self._shown:
            before = self._shown and self._shown[0]
            self._pair, self._shown = pair, shown
            self._explain(pair, picked, snapshot.parameters, palette)
            # A click in the scene brings the story to a card there.
            if picked not in (None, before) and snapshot.inspected.pinned is None:
                call(self._client, "story.show")

    def _explain(
        self, pair: Pair, picked: int | None, parameters: Parameters, palette: Palette
    ) -> None:
        assert pair.flow is not None
        clusters = pair.flow.clusters
        names = {_name(cluster): cluster.index for cluster in clusters}
        self._choices({_NONE: None, **names}, picked)
        cluster = cluster_of(pair, picked)
        self._story.content = (
            framed(
                "Click on a point in the scene, or on a row of the table, for a cluster's story."
            )
            if cluster is None
            else f'<div id="tofscope-story">{story(cluster, parameters, palette)}</div>'
        )
        self._table.content = cluster_table(
            clusters,
            picked,
            palette,
            # A click on the picked one clears the selection.
            lambda cluster: sets(self._list, _NONE if cluster.index == picked else _name(cluster)),
        )
        self._draw_histograms(clusters, cluster, parameters, palette)

    def _draw_histograms(
        self,
        clusters: Sequence[ClusterResult],
        picked: ClusterResult | None,
        parameters: Parameters,
        palette: Palette,
    ) -> None:
        """Draw fitness and displacement of all clusters, for methods that have rounds of ICP."""
        told = [(cluster, turn) for cluster in clusters if (turn := telling_round(cluster))]
        if not told:
            self._fitness.content = self._displacement.content = ""
            return
        marked = telling_round(picked) if picked else None
        self._fitness.content = Histogram(
            title="Fitness",
            values=[(turn.fitness, cluster.label) for cluster, turn in told],
            upper=1.0,
            bars=round(1.0 / _STEP),
            threshold=("γ", parameters.gamma),
            palette=palette,
            marked=marked.fitness if marked else None,
        ).svg()
        moved = [(turn.mean_displacement, cluster.label) for cluster, turn in told]
        self._displacement.content = Histogram(
            title="Mean displacement [m]",
            values=moved,
            upper=upper_limit([*(value for value, _ in moved), 2 * parameters.delta]),
            bars=_BARS,
            threshold=("δ", parameters.delta),
            palette=palette,
            marked=marked.mean_displacement if marked else None,
        ).svg() + legend(palette)

    def _choices(self, indices: dict[str, int | None], picked: int | None) -> None:
        options = tuple(indices)
        if options != self._list.options:
            self._list.options = options
        show_value(self._list, next(name for name, index in indices.items() if index == picked))


def _pick(chosen: str) -> Command:
    """Command for an option; its number counts, since labels change with the estimate."""
    number = chosen.partition(" ")[0]
    if chosen == _NONE:
        return PickCluster(None)
    if number.isdecimal() and len(number) < 10:
        return PickCluster(int(number))
    return Refuse(f"There is no cluster {reprlib.repr(chosen)}; choose one of the list.")


def _name(cluster: ClusterResult) -> str:
    return f"{cluster.index} {cluster.label.name.lower()}"
