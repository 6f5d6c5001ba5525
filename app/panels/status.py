"""Numbers of the current pair."""

import math
from collections.abc import Iterator
from dataclasses import dataclass
from html import escape

import numpy as np
from numpy.typing import NDArray

from app.analysis.pairs import Pair
from app.analysis.quantities import page_unit
from app.panels.panel import Panel, PanelContext
from app.panels.tables import PLOTTED, framed, metric_title
from app.scene.colours import Colour, css
from app.scene.palettes import Palette
from app.session.snapshot import Snapshot
from estimator import METRIC_INFO, Label, Parameters, SceneFlow, find_method

_NOTHING = "–"


@dataclass(frozen=True)
class Fact:
    """A number of a pair, with the scene's colour of what it counts."""

    name: str
    value: str
    colour: Colour | None = None


class StatusPanel(Panel):
    """Counts of points, clusters and labels, duration of the estimate, and errors."""

    def __init__(self, context: PanelContext) -> None:
        gui = context.client.gui
        self._shown: Pair | None = None
        self._colours: Palette | None = None
        self._content = gui.add_html("")

    def show(self, snapshot: Snapshot) -> None:
        """Show the numbers of the pair."""
        if snapshot.pair is None:
            self._shown = None
            self._content.content = framed("This frame cannot be shown.")
            return
        if snapshot.pair is self._shown and snapshot.settings.palette is self._colours:
            return
        pair = self._shown = snapshot.pair
        colours = self._colours = snapshot.settings.palette
        origin = "simulated" if snapshot.opened.recording.simulated else "measured"
        cells = "".join(_cell(fact) for fact in [*facts(pair, colours), Fact("Recording", origin)])
        grid = "display: grid; grid-template-columns: 1fr 1fr; column-gap: 1em"
        note = note_on(pair, snapshot.parameters, snapshot.opened.recording.truth_frame)
        # Room for the note is always kept, so that controls below stay in place during a drag.
        note = f'<div style="min-height: 2.4em; line-height: 1.2">{escape(note)}</div>'
        self._content.content = framed(f'<div style="{grid}">{cells}</div>{note}')


def facts(pair: Pair, colours: Palette) -> list[Fact]:
    """All numbers of a pair, in rows of two; – where undefined."""
    source = len(pair.source.points) if pair.source else 0
    flow, errors = pair.flow, pair.errors
    labels = flow.label if flow else None
    speed = None if pair.object_velocity is None else float(np.linalg.norm(pair.object_velocity))
    return [
        Fact("Source", str(source), colours.source),
        Fact("Target", str(len(pair.target.points)), colours.target),
        Fact("Moving", _count(labels, Label.MOVING), colours.flow),
        Fact("Stationary", _count(labels, Label.STATIONARY), colours.stationary),
        Fact("Clusters", str(len(flow.clusters)) if flow else _NOTHING),
        Fact("Unassigned", _count(labels, Label.UNASSIGNED), colours.unassigned),
        Fact("Δt of the pair", _number(pair.interval, ".3f", " s")),
        Fact("Compute time", _compute_time(pair)),
        Fact("True speed", _number(speed, ".3f", " m/s"), colours.truth),
        *(_metric(name, getattr(errors, name) if errors else None) for name in PLOTTED),
    ]


def _compute_time(pair: Pair) -> str:
    return "reused" if pair.reused else _number(pair.milliseconds, ".0f", " ms")


def _metric(name: str, value: float | None) -> Fact:
    unit = page_unit(METRIC_INFO[name].unit)
    apart = unit if unit in ("", "°") else f" {unit}"
    return Fact(metric_title(name), _number(value, METRIC_INFO[name].spec, apart))


def note_on(pair: Pair, parameters: Parameters, truth_frame: str | None = None) -> str:
    """Reason why there is no flow or no truth, and what to do about it.

    Args:
        pair: the current one.
        parameters: of its estimate.
        truth_frame: frame whose motion is the truth, None unless one was given.
    """
    if pair.source is None:
        return f"No pair: frame k-n = {pair.frame - parameters.n} is before the start."
    if pair.flow is None:
        return "No estimate."
    if pair.truth is not None and pair.object_velocity is None and len(pair.source.points):
        return "The moving object is at rest."
    if not pair.flow.moving.any():
        return _why_nothing_moves(pair, pair.flow, parameters)
    said = [] if pair.truth else [_why_no_truth(truth_frame)]
    return " ".join([*said, *_why_unassigned(pair.flow, parameters)])


def _why_unassigned(flow: SceneFlow, parameters: Parameters) -> list[str]:
    """Sentence on why source points are Unassigned, as far as the method's clusters tell."""
    if not flow.clusters:
        return []
    alone = np.count_nonzero((flow.cluster < 0) & (flow.label == Label.UNASSIGNED))
    small = unmatched = 0
    if "n_min" in find_method(parameters.method).uses:
        for cluster in flow.clusters:
            if cluster.label is not Label.UNASSIGNED:
                continue
            if max(len(cluster.source), len(cluster.target)) < parameters.n_min:
                small += len(cluster.remaining)
            else:
                unmatched += len(cluster.remaining)
    reasons = (
        (alone, "in no cluster"),
        (small, "in clusters below N_min"),
        (unmatched, "in clusters that ICP did not match"),
    )
    said = [f"{number} {reason}" for number, reason in reasons if number]
    return [f"Unassigned: {', '.join(said)}."] if said else []


def _why_no_truth(truth_frame: str | None) -> str:
    if truth_frame is not None:
        return "No truth here: the truth frame has no pose over this pair."
    return "No truth here: errors are known with --truth-frame, or where a target is recorded."


def _why_nothing_moves(pair: Pair, flow: SceneFlow, parameters: Parameters) -> str:
    size = len(flow.label)
    if size == 0 or len(pair.target.points) == 0:
        empty = "source" if size == 0 else "target"
        return f"No motion found: the {empty} is empty."
    uses = find_method(parameters.method).uses
    reason = next((text for name, text in _reasons(flow, parameters) if name in uses), "")
    return f"No motion found: {reason}." if reason else "No motion found."


def _reasons(flow: SceneFlow, parameters: Parameters) -> Iterator[tuple[str, str]]:
    """Reasons why nothing moves, each after the parameter that it depends on, the first first."""
    if not flow.clusters:
        hint = "" if parameters.allow_single_cluster else " or allow a single cluster"
        yield "min_cluster_size", f"no clusters; try a smaller min_cluster_size{hint}"
        return
    if all(len(c.source) < parameters.n_min > len(c.target) for c in flow.clusters):
        largest = max(max(len(c.source), len(c.target)) for c in flow.clusters)
        yield "n_min", f"every cluster is below N_min; the largest has {largest} points"
    if stationary := [c for c in flow.clusters if c.label is Label.STATIONARY]:
        most = max(c.mean_displacement for c in stationary)
        yield "delta", f"displacements reach {most:.3f} m, below δ"
    fitness = max((r.fitness for c in flow.clusters for r in c.rounds), default=0.0)
    yield "gamma", f"fitness reaches {fitness:.2f}, not above γ"


def _count(labels: NDArray[np.int64] | None, label: Label) -> str:
    return _NOTHING if labels is None else str(np.count_nonzero(labels == label))


def _number(value: float | None, form: str, unit: str) -> str:
    return _NOTHING if value is None or math.isnan(value) else f"{value:{form}}{unit}"


def _cell(fact: Fact) -> str:
    background = css(fact.colour) if fact.colour else "transparent"
    return (
        '<div style="display: flex; align-items: center; white-space: nowrap">'
        '<span style="width: 0.6em; height: 0.6em; border-radius: 50%; margin-right: 0.5em;'
        f' flex: none; background: {background}"></span>'
        f'<span style="flex: 1">{escape(fact.name)}</span>'
        f'<span style="font-variant-numeric: tabular-nums">{escape(fact.value)}</span></div>'
    )
