"""Plots of surveys as a figure for print: PNG, SVG or PDF."""

import threading
from collections.abc import Mapping, Sequence
from io import BytesIO
from typing import TYPE_CHECKING, Any

import numpy as np

from app.analysis.comparison import A
from app.analysis.quantities import QUANTITIES, times
from app.analysis.survey import Survey
from app.exports.captions import caption, origin
from app.output.text import escaped
from app.scene.colours import Colour
from app.scene.palettes import PAPER, Palette, palette
from estimator import METRIC_INFO
from recordings import Recording

if TYPE_CHECKING:
    from matplotlib.axes import Axes

FORMS = ("png", "svg", "pdf")
"""Endings of the files that can be made."""

_WIDTH, _HEIGHT, _SQUARE = 5.2, 0.9, 2.6  # inches: of all plots, of one, of two quantities
_AROUND = 1.1  # inches, for title, times and legend
_DPI = 300
_DRAWING = threading.Lock()  # settings of matplotlib are those of all threads
_MOST = 4000  # points of a vector file; more are drawn as an image in it, axes and text stay vector


def survey_figure(
    recording: Recording,
    surveys: Mapping[str, Survey],
    names: Sequence[str],
    form: str,
    *,
    pair: tuple[str, str] | None = None,
    colours: str = PAPER,
) -> bytes:
    """Draw quantities over time, and two against each other, on white.

    Points of pairs that do not count in the means are hollow. Parameters are in the file's
    metadata.

    Args:
        recording: of the surveys.
        surveys: {A or B: its survey}.
        names: of the quantities over time, from top to bottom.
        form: one of `FORMS`.
        pair: quantities (x, y) to plot against each other below, None for none.
        colours: name of the palette.
    """
    import matplotlib as mpl
    from matplotlib.figure import Figure

    # Fonts of their own kind keep text as text. Without dates, equal plots give equal files.
    settings: dict[Any, Any] = {
        "pdf.fonttype": 42,
        "svg.fonttype": "none",
        "svg.hashsalt": "tofscope",
        "font.size": 7,
        "font.family": "DejaVu Sans",
        "axes.unicode_minus": True,
    }
    heights = [_HEIGHT] * len(names) + ([_SQUARE] if pair else [])
    with _DRAWING, mpl.rc_context(settings):
        figure = Figure((_WIDTH, sum(heights) + _AROUND), layout="constrained")
        axes = figure.subplots(len(heights), 1, squeeze=False, height_ratios=heights)[:, 0]
        look = palette(colours, dark=False)
        for axis, name in zip(axes, names, strict=False):
            _draw_over_time(axis, recording, surveys, name, look)
            axis.sharex(axes[0])
            axis.tick_params(labelbottom=name == names[-1])
        axes[len(names) - 1].set_xlabel(QUANTITIES["time"].label)
        if pair:
            _draw_pair(axes[-1], recording, surveys, pair, look)
        figure.suptitle(_title(recording), fontsize=7)
        handles, labels = _legend(surveys, recording, look)
        figure.legend(
            handles,
            labels,
            loc="outside lower center",
            ncols=len(labels),
            frameon=False,
            fontsize=6,
        )
        content = BytesIO()
        figure.savefig(content, format=form, dpi=_DPI, metadata=_metadata(recording, surveys, form))
    return content.getvalue()


def _draw_over_time(
    axis: "Axes", recording: Recording, surveys: Mapping[str, Survey], name: str, look: Palette
) -> None:
    quantity, seconds = QUANTITIES[name], times(recording)
    for side, survey in surveys.items():
        values = quantity.values(recording, survey)
        _draw_points(axis, seconds, values, _filled(recording, survey), look, side)
    if name == "speed" and recording.has_truth:
        first = next(iter(surveys.values()))
        axis.plot(seconds, first.true_speed, color=_rgb(look.truth), linewidth=0.8)
    axis.set_xlim(seconds[0], max(seconds[-1], 1e-3))
    if quantity.kind == "share":
        axis.set_ylim(-0.05, 1.05)
    elif quantity.kind == "signed":
        axis.set_ylim(*(np.max(np.abs(axis.get_ylim())) * np.array([-1.0, 1.0])))
    else:
        axis.set_ylim(bottom=0 - 0.05 * axis.get_ylim()[1])
    axis.set_title(_with_means(recording, surveys, name), fontsize=7, loc="left", pad=2)
    _plain(axis)


def _draw_pair(
    axis: "Axes",
    recording: Recording,
    surveys: Mapping[str, Survey],
    pair: tuple[str, str],
    look: Palette,
) -> None:
    x, y = (QUANTITIES[name] for name in pair)
    for side, survey in surveys.items():
        filled = _filled(recording, survey)
        across, up = x.values(recording, survey), y.values(recording, survey)
        _draw_points(axis, across, up, filled, look, side)
    axis.set_xlabel(x.label)
    axis.set_ylabel(y.label)
    _plain(axis)


def _draw_points(
    axis: "Axes", x: np.ndarray, y: np.ndarray, filled: np.ndarray, look: Palette, side: str
) -> None:
    known = np.isfinite(x) & np.isfinite(y)
    size = 2.6 if side == A else 1.9
    for chosen, face in ((known & ~filled, "none"), (known & filled, _rgb(look.side(side)))):
        (points,) = axis.plot(
            x[chosen],
            y[chosen],
            linestyle="none",
            marker="o",
            markersize=size,
            markeredgewidth=0.5,
            color=_rgb(look.side(side)),
            markerfacecolor=face,
            rasterized=bool(np.count_nonzero(chosen) > _MOST),
        )
        # Points at the ends stay whole, and take no room of their own.
        points.set(clip_on=False, in_layout=False)


def _with_means(recording: Recording, surveys: Mapping[str, Survey], name: str) -> str:
    """Title of a plot, with the means of a metric over the pairs that count."""
    title = QUANTITIES[name].label
    if name not in METRIC_INFO or not recording.has_truth:
        return title
    said = [
        f"{f'{side} ' if len(surveys) > 1 else ''}{METRIC_INFO[name].text(mean)}, "
        f"{np.count_nonzero(survey.counts)} of {survey.pairs} pairs count"
        for side, survey in surveys.items()
        for mean in [getattr(survey.summary(), name)]
    ]
    return f"{title}: mean {'; '.join(said)}"


def _legend(
    surveys: Mapping[str, Survey], recording: Recording, look: Palette
) -> tuple[list[Any], list[str]]:
    from matplotlib.lines import Line2D

    def dot(colour: tuple[float, float, float], face: Any) -> Line2D:  # noqa: ANN401 (of matplotlib)
        style = {"linestyle": "none", "marker": "o", "markersize": 3, "markeredgewidth": 0.5}
        return Line2D([], [], color=colour, markerfacecolor=face, **style)

    found = {
        side if len(surveys) > 1 else "estimated": dot(colour, colour)
        for side in surveys
        for colour in [_rgb(look.side(side))]
    }
    if recording.has_truth:
        found["true"] = Line2D([], [], color=_rgb(look.truth), linewidth=0.8)
        found["hollow: does not count in the means"] = dot(_rgb(look.flow), "none")
    return list(found.values()), list(found)


def _title(recording: Recording) -> str:
    # matplotlib would set what stands between dollars as a formula.
    return escaped(f"{recording.name} ({origin(recording)})").replace("$", r"\$")


def _metadata(recording: Recording, surveys: Mapping[str, Survey], form: str) -> dict[str, Any]:
    """What the file says of itself, under the names that its format has."""
    first, *others = surveys.values()
    sides = {side: s.parameters for side, s in surveys.items()} if others else {}
    entries = dict(caption(recording, first.parameters, None, sides))
    missing = [side for side, survey in surveys.items() if not survey.complete]
    if missing:
        entries["Incomplete"] = f"not all frames of {', '.join(missing)} are computed"
    said = "; ".join(f"{name}: {value}" for name, value in entries.items())
    match form:
        case "png":
            return {"Software": "Tofscope", **entries}
        case "svg":
            return {"Creator": "Tofscope", "Description": said, "Date": None}
        case _:
            return {"Creator": "Tofscope", "Subject": said, "CreationDate": None}


def _filled(recording: Recording, survey: Survey) -> np.ndarray:
    return survey.counts if recording.has_truth else np.ones(len(survey), dtype=bool)


def _rgb(colour: Colour) -> tuple[float, float, float]:
    red, green, blue = colour
    return red / 255, green / 255, blue / 255


def _plain(axis: "Axes") -> None:
    axis.grid(axis="y", color="0.9", linewidth=0.4)
    axis.set_axisbelow(True)
    for side in ("top", "right"):
        axis.spines[side].set_visible(False)
