"""What was seen in the pair, in numbers."""

from html import escape

import numpy as np
import viser

from app.colours import FLOW, SOURCE, TARGET, TRUTH, Colour, css
from app.estimates import Pair
from estimator import Label, Parameters, SceneFlow


class StatusPanel:
    """Says how many points, clusters and labels there are, how long it took, and how good it is.

    Args:
        gui: of the client.
    """

    def __init__(self, gui: viser.GuiApi) -> None:
        with gui.add_folder("Status"):
            self._table = gui.add_html("")

    def show(self, pair: Pair, parameters: Parameters, *, simulated: bool) -> None:
        """Show a pair."""
        rows = status_rows(pair, parameters)
        cells = "".join(
            f"<tr><td>{_mark(colour)}{escape(name)}</td>"
            f'<td style="text-align: right; font-variant-numeric: tabular-nums">'
            f"{escape(value)}</td></tr>"
            for name, value, colour in rows
        )
        note = "<div>Simulated data</div>" if simulated else ""
        self._table.content = (
            '<div style="font-size: 0.8rem; padding: 0 1em; line-height: 1.45">'
            f'<table style="width: 100%; border-collapse: collapse">{cells}</table>{note}</div>'
        )


def status_rows(pair: Pair, parameters: Parameters) -> list[tuple[str, str, Colour | None]]:
    """(name, value, colour of the legend) of everything that is said about a pair."""
    rows: list[tuple[str, str, Colour | None]] = [
        ("Target points", str(len(pair.target.points)), TARGET)
    ]
    if pair.source is None:
        said = f"no pair: frame k-n = {pair.frame - parameters.n} is before the start"
        return [*rows, (said, "", None)]
    rows.insert(0, ("Source points", str(len(pair.source.points)), SOURCE))
    if pair.flow is None:
        return [*rows, ("no estimate", "", None)]
    rows += [
        ("Moving", str(_count(pair.flow, Label.MOVING)), FLOW),
        ("Stationary", str(_count(pair.flow, Label.STATIONARY)), None),
        ("Unassigned", str(_count(pair.flow, Label.UNASSIGNED)), None),
        ("Clusters", str(len(pair.flow.clusters)), None),
        ("Interval", f"{pair.interval:.3f} s", None),
        ("Estimate", f"{pair.milliseconds:.0f} ms", None),
    ]
    return rows + _against_truth(pair)


def _against_truth(pair: Pair) -> list[tuple[str, str, Colour | None]]:
    if pair.truth is None:
        return []
    if pair.object_velocity is None:
        return [("True velocity", "at rest", TRUTH)]
    speed = float(np.linalg.norm(pair.object_velocity))
    rows: list[tuple[str, str, Colour | None]] = [("True velocity", f"{speed:.3f} m/s", TRUTH)]
    errors = pair.errors
    if errors is not None and errors.points_with_flow > 0:
        rows += [
            ("Angle error", f"{errors.angle_deg:.1f}°", None),
            ("Velocity error", f"{errors.velocity_error:.3f} m/s", None),
        ]
    return rows


def _count(flow: SceneFlow, label: Label) -> int:
    return int(np.count_nonzero(flow.label == label))


def _mark(colour: Colour | None) -> str:
    background = css(colour) if colour else "transparent"
    return (
        '<span style="display: inline-block; width: 0.65em; height: 0.65em; border-radius: 50%;'
        f' margin-right: 0.5em; background: {background}"></span>'
    )
