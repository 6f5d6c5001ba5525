"""Definitions and style of the plots."""

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np
import viser

from app.analysis.survey import Survey
from app.panels.histograms import upper_limit
from app.panels.tables import PLOTTED, metric_label, page_unit
from app.scene.colours import Colour, css
from app.scene.palettes import Palette
from estimator import METRIC_INFO

_HEIGHT = 58  # pixels
_FONT = "10px sans-serif"
_SMALL = "font-size: 0.75rem; padding: 0 1em; line-height: 1.5"


@dataclass(frozen=True)
class Line:
    """One series of points in a plot.

    Attributes:
        label: empty if the plot's title suffices.
        name: attribute or metric of the survey.
        form: format of its values.
        colour: of the points, as in the scene.
        needs_truth: whether it is empty without truth.
    """

    label: str
    name: str
    form: str
    colour: Callable[[Palette], Colour]
    needs_truth: bool = False


@dataclass(frozen=True)
class PlotSpec:
    """One plot over the whole recording.

    Attributes:
        title: without the unit.
        unit: "" for none.
        lines: its series.
        needs_truth: whether all series need truth.
        top: end of the vertical axis, None to follow the data.
        signed: whether values may be negative; 0 is then in the middle of the axis.
    """

    title: str
    unit: str
    lines: tuple[Line, ...]
    needs_truth: bool
    top: float | None = None
    signed: bool = False

    def heading(
        self, survey: Survey | None, frame: int, colours: Palette, *, has_truth: bool
    ) -> str:
        """HTML of the title and of the values at a frame."""
        lines = [line for line in self.lines if has_truth or not line.needs_truth]
        values = "".join(self._value(line, survey, frame, colours) for line in lines)
        unit = f' <span style="opacity: 0.6">[{self.unit}]</span>' if self.unit else ""
        return (
            '<div style="font-size: 0.75rem; padding: 0 1em; display: flex; white-space: nowrap">'
            f'<b style="flex: 1; font-weight: 500">{self.title}{unit}</b>{values}</div>'
        )

    def data(self, survey: Survey) -> tuple[np.ndarray, ...]:
        """Values of each line at every frame."""
        return tuple(_values(survey, line.name) for line in self.lines)

    def scales(self, seconds: float, survey: Survey | None) -> dict[str, Any]:
        """Axis ranges: the whole recording; values from 0, or symmetric, to a round number."""
        top = self.top
        if top is None:
            top = upper_limit(np.abs(np.concatenate(self.data(survey))) if survey else [])
        # A margin, so that points at the ends are not cut.
        bottom = -1.06 * top if self.signed else -0.06 * top
        return {
            "x": {"time": False, "range": (0.0, seconds)},
            "y": {"range": (bottom, 1.06 * top)},
        }

    def series(self, colours: Palette) -> Any:  # noqa: ANN401 (viser's dictionaries)
        """Style of the series: points, since lines would bridge undefined values."""
        # Equal values stay visible: later series have smaller points in front.
        sizes = (4,) if len(self.lines) == 1 else (6, *[3] * (len(self.lines) - 1))
        return (
            {},
            *(
                {
                    "label": line.label or self.title,
                    "stroke": css(line.colour(colours)),
                    "width": 0,
                    "points": {
                        "show": True,
                        "size": size,
                        "width": 0,
                        "fill": css(line.colour(colours)),
                    },
                }
                for line, size in zip(self.lines, sizes, strict=True)
            ),
        )

    def label_times(self, handle: viser.GuiUplotHandle, *, labelled: bool) -> None:
        """Show or hide the labels of the horizontal axis, and adapt the height."""
        handle.axes = _axes(labelled=labelled)
        handle.height = _HEIGHT + (14 if labelled else 0)

    def add_to(self, gui: viser.GuiApi, colours: Palette) -> viser.GuiUplotHandle:
        """Add the plot to a page, without labels of its horizontal axis."""
        options: dict[str, Any] = {
            "scales": self.scales(1.0, None),
            "axes": _axes(labelled=False),
            "legend": {"show": False},
            # Clicks seek, and must not start a zoom.
            "cursor": {
                "drag": {"x": False, "y": False},
                "y": False,
                "points": {"show": False},
            },
            "height": _HEIGHT,
            "padding": (4, 8, 0, 0),
        }
        data = (np.array([0.0, 1.0]), *[np.full(2, np.nan)] * len(self.lines))
        return gui.add_uplot(data, self.series(colours), **options)

    def _value(self, line: Line, survey: Survey | None, frame: int, colours: Palette) -> str:
        value = float(_values(survey, line.name)[frame]) if survey else math.nan
        text = "–" if math.isnan(value) else format(value, line.form)
        return (
            '<span style="width: 0.6em; height: 0.6em; border-radius: 50%; align-self: center;'
            f' margin: 0 0.4em 0 0.9em; background: {css(line.colour(colours))}"></span>'
            f'{line.label}<span style="font-variant-numeric: tabular-nums; text-align: right;'
            f' margin-left: 0.4em; min-width: 2.5em">{text}</span>'
        )


def _values(survey: Survey, name: str) -> np.ndarray:
    return survey.metrics[name] if name in survey.metrics else getattr(survey, name)


def _axes(*, labelled: bool) -> tuple[Any, ...]:
    axis = {"font": _FONT, "ticks": {"size": 3, "width": 1}, "gap": 3}
    horizontal = {"size": 18} if labelled else {"size": 4, "values": ()}
    return ({**axis, **horizontal, "space": 40}, {**axis, "size": 42, "space": 18})


def _flow(colours: Palette) -> Colour:
    return colours.flow


def _metric_plots() -> Iterator[PlotSpec]:
    """One plot per metric, and one of all shares."""
    infos = {name: METRIC_INFO[name] for name in PLOTTED}
    shares = {name: info for name, info in infos.items() if info.kind == "share"}
    for name, info in infos.items():
        if name not in shares:
            yield PlotSpec(
                title=info.title[:1].upper() + info.title[1:],
                unit=page_unit(info.unit),
                lines=(Line("", name, info.spec, _flow),),
                needs_truth=True,
                signed=info.kind == "signed",
            )
    lines = tuple(
        Line(info.short, name, info.spec, lambda colours, index=index: colours.category(index))
        for index, (name, info) in enumerate(shares.items())
    )
    if lines:
        yield PlotSpec("Shares", "", lines, True, top=1.0)


PLOTS = (
    PlotSpec("Moving points", "", (Line("", "moving", ".0f", _flow),), False),
    PlotSpec(
        "Speed",
        "m/s",
        (
            Line("est.", "speed", ".3f", _flow),
            Line("true", "true_speed", ".3f", lambda colours: colours.truth, needs_truth=True),
        ),
        False,
    ),
    *_metric_plots(),
)
"""All plots, from top to bottom."""


def summary(survey: Survey | None, *, has_truth: bool) -> str:
    """HTML of the means over the pairs that count, of their progress, or of why there are none.

    Its height is constant, so that the plots below stay in place.
    """
    share = float(survey.done.mean()) if survey else 0.0
    if survey is None or share < 1:
        frames = f"{np.count_nonzero(survey.done)} of {len(survey)} frames" if survey else ""
        sentence = f"Computing the whole recording: {frames}"
    elif not has_truth:
        sentence = "No truth in this recording: no errors, coverage and precision."
    else:
        sentence = _means(survey)
    bar = (
        '<div style="height: 3px; border-radius: 2px; background: currentColor;'
        f' width: {100 * share:.0f}%; opacity: {0.5 if share < 1 else 0}"></div>'
    )
    return f'<div style="{_SMALL}"><div style="min-height: 4.5em">{sentence}</div>{bar}</div>'


def _means(survey: Survey) -> str:
    metrics = survey.summary()
    if metrics.pairs == 0:
        sentence = "No pair counts: the object must move at both of its frames."
        flagged = format(100 * metrics.false_flow, ".2f")
        known = not math.isnan(metrics.false_flow)
        return f"{sentence} Of the points at rest {flagged} % got a flow." if known else sentence
    cells = []
    for name in PLOTTED:
        value = getattr(metrics, name)
        text = METRIC_INFO[name].text(value)
        cells.append(
            f'<span style="display: flex"><span style="flex: 1">{metric_label(name)}</span>'
            f'<span style="font-variant-numeric: tabular-nums">{text}</span></span>'
        )
    grid = "display: grid; grid-template-columns: 1fr 1fr; column-gap: 1em"
    pairs = "1 pair" if metrics.pairs == 1 else f"{metrics.pairs} pairs"
    return (
        f"<div>Means, {pairs} with {metrics.points_with_flow} flow points</div>"
        f'<div style="{grid}">{"".join(cells)}</div>'
    )
