"""What was seen in the pair, in numbers."""

from dataclasses import dataclass
from html import escape

import numpy as np

from app.colours import Colour, css
from app.estimates import Pair
from app.palettes import Palette
from app.panel import Desk, Panel, Shown
from estimator import Label, Parameters


@dataclass(frozen=True)
class Fact:
    """One thing that is said about a pair, with its colour in the scene if it has one."""

    name: str
    value: str
    colour: Colour | None = None


class StatusPanel(Panel):
    """Says how many points, clusters and labels there are, how long it took, and how good it is."""

    def __init__(self, desk: Desk) -> None:
        gui = desk.client.gui
        self._said: Pair | None = None
        self._colours: Palette | None = None
        with gui.add_folder("Status"):
            self._content = gui.add_html("")

    def show(self, shown: Shown) -> None:
        """Say what is to be said of the pair."""
        if shown.pair is None:
            self._said = None
            self._content.content = _framed("This frame cannot be shown.")
            return
        if shown.pair is self._said and shown.settings.palette is self._colours:
            return
        pair = self._said = shown.pair
        colours = self._colours = shown.settings.palette
        lines = [f"<div>{escape(text)}</div>" for text in notes(pair, shown.parameters)]
        said = facts(pair, colours)
        if shown.opened.recording.simulated:
            said.append(Fact("Data", "simulated"))
        cells = "".join(_cell(fact) for fact in said)
        grid = "display: grid; grid-template-columns: 1fr 1fr; column-gap: 1em"
        self._content.content = _framed(f'<div style="{grid}">{cells}</div>{"".join(lines)}')


def _framed(content: str) -> str:
    return f'<div style="font-size: 0.75rem; padding: 0 1em; line-height: 1.5">{content}</div>'


def facts(pair: Pair, colours: Palette) -> list[Fact]:
    """The numbers of a pair, in the order in which they are read, two in a row."""
    source = len(pair.source.points) if pair.source else 0
    found = [
        Fact("Source", str(source), colours.source),
        Fact("Target", str(len(pair.target.points)), colours.target),
    ]
    if pair.flow is None:
        return found
    labels = pair.flow.label
    found += [
        Fact("Moving", str(np.count_nonzero(labels == Label.MOVING)), colours.flow),
        Fact("Stationary", str(np.count_nonzero(labels == Label.STATIONARY)), colours.stationary),
        Fact("Clusters", str(len(pair.flow.clusters))),
        Fact("Unassigned", str(np.count_nonzero(labels == Label.UNASSIGNED)), colours.unassigned),
        Fact("Interval", f"{pair.interval:.3f} s"),
        Fact("Estimate", f"{pair.milliseconds:.0f} ms"),
    ]
    if pair.object_velocity is not None:
        found.append(
            Fact("Truth", f"{np.linalg.norm(pair.object_velocity):.3f} m/s", colours.truth)
        )
    errors = pair.errors
    if errors is not None and errors.points_with_flow > 0:
        found += [
            Fact("Angle error", f"{errors.angle_deg:.1f}°"),
            Fact("Vel. error", f"{errors.velocity_error:.3f} m/s"),
        ]
    return found


def notes(pair: Pair, parameters: Parameters) -> list[str]:
    """What the numbers cannot say, in short sentences."""
    if pair.source is None:
        missing = pair.frame - parameters.n
        return [f"No pair: frame k-n = {missing} is before the start."]
    said: list[str] = []
    if pair.flow is None:
        said.append("No estimate.")
    if pair.truth is not None and pair.object_velocity is None:
        said.append("The moving object is at rest.")
    return said


def _cell(fact: Fact) -> str:
    background = css(fact.colour) if fact.colour else "transparent"
    return (
        '<div style="display: flex; align-items: center; white-space: nowrap">'
        '<span style="width: 0.6em; height: 0.6em; border-radius: 50%; margin-right: 0.5em;'
        f' flex: none; background: {background}"></span>'
        f'<span style="flex: 1">{escape(fact.name)}</span>'
        f'<span style="font-variant-numeric: tabular-nums">{escape(fact.value)}</span></div>'
    )
