"""Figure of the sweep of n, readable in print without colour."""

from io import BytesIO
from typing import TYPE_CHECKING, Any

from app.study.further_tables import error_percent
from app.study.paper import method_label
from app.study.plan import Plan
from app.study.rows import Row, cell, speeds_of, values
from app.study.work import SWEPT_SCENARIO

if TYPE_CHECKING:
    from matplotlib.axes import Axes

# Okabe and Ito's colour-blind safe colours; dashes and markers differ too, for print without
# colour.
_STYLES = (
    ("#000000", "-", "o"),
    ("#0072B2", "--", "s"),
    ("#D55E00", "-.", "^"),
    ("#009E73", ":", "D"),
    ("#CC79A7", (0, (6, 1, 1, 1, 1, 1)), "v"),
)
_WIDTH, _HEIGHT = 3.5, 2.7  # inches: a column of a paper
_DPI = 300


def sweep_figure(plan: Plan, rows: list[Row]) -> dict[str, bytes] | None:
    """Draw the sweep as {ending: file content} for PNG and PDF; None without a sweep."""
    speeds = speeds_of(rows, SWEPT_SCENARIO)
    if not plan.sweep or not speeds:
        return None
    import matplotlib as mpl
    from matplotlib.figure import Figure

    # Type 42 keeps PDF text as text. Without dates, equal studies give equal files.
    settings: dict[Any, Any] = {"pdf.fonttype": 42, "font.size": 8, "font.family": "DejaVu Sans"}
    with mpl.rc_context(settings):
        figure = Figure((_WIDTH * len(plan.methods), _HEIGHT), layout="constrained")
        panels = figure.subplots(1, len(plan.methods), squeeze=False)[0]
        for panel, method in zip(panels, plan.methods, strict=True):
            _draw(panel, plan, rows, method, speeds)
        figure.legend(
            *panels[0].get_legend_handles_labels(),
            loc="outside upper center",
            ncols=len(speeds) if len(plan.methods) > 1 else 2,
            frameon=False,
            handlelength=3.2,
            columnspacing=1.2,
        )
        figure.supxlabel(
            "filled: every trial gave a flow; open: some did, and the error is theirs", fontsize=7
        )
        files: dict[str, bytes] = {}
        for ending, extra in (("png", {"Software": None}), ("pdf", {"CreationDate": None})):
            content = BytesIO()
            figure.savefig(content, format=ending, dpi=_DPI, metadata=extra)
            files[ending] = content.getvalue()
    return files


def _draw(panel: "Axes", plan: Plan, rows: list[Row], method: str, speeds: list[float]) -> None:
    sweep = sorted(plan.sweep)
    errors = {
        speed: [error_percent(cell(rows, SWEPT_SCENARIO, method, speed, n)) for n in sweep]
        for speed in speeds
    }
    highest = max((e for found in errors.values() for e in found if e is not None), default=100.0)
    missing = any(e is None for found in errors.values() for e in found)
    # Cells that could not be computed are marked in a band above all errors.
    low, high = 1.12 * highest, 1.36 * highest
    if missing:
        panel.axhspan(low, high, facecolor="0.93", edgecolor="0.75", hatch="////", linewidth=0)
        panel.text(
            0.5,
            (high - 0.02 * highest) / high,
            "could not be computed",
            transform=panel.transAxes,
            ha="center",
            va="top",
            bbox={"facecolor": "white", "edgecolor": "none", "pad": 0.8},
        )
    for i, speed in enumerate(speeds):
        color, dash, marker = _STYLES[i % len(_STYLES)]
        found = errors[speed]
        drawn = [float("nan") if e is None else e for e in found]
        whole = [_every_trial(cell(rows, SWEPT_SCENARIO, method, speed, n)) for n in sweep]
        look = {"color": color, "marker": marker, "markersize": 3.6, "linewidth": 1.2}
        panel.plot(sweep, drawn, linestyle=dash, label=f"{speed:.2f} m/s", **look)
        panel.plot(
            [n for n, all_there in zip(sweep, whole, strict=True) if not all_there],
            [e for e, all_there in zip(drawn, whole, strict=True) if not all_there],
            linestyle="none",
            markerfacecolor="white",
            **look,
        )
        aside = 0.16 * (i - (len(speeds) - 1) / 2)
        panel.plot(
            [n + aside for n, e in zip(sweep, found, strict=True) if e is None],
            [low + 0.08 * highest] * sum(e is None for e in found),
            color=color,
            linestyle="none",
            marker=marker,
            markersize=3,
            markerfacecolor="white",
        )
    panel.set_title(method_label(method), fontsize=8)
    panel.set_xlabel("n (frames)")
    panel.set_ylabel("error (% of target speed)")
    panel.set_xticks(sweep)
    panel.set_xlim(sweep[0] - 0.6, sweep[-1] + 0.6)
    panel.set_ylim(0, high if missing else 1.08 * highest)
    panel.set_yticks([tick for tick in panel.get_yticks() if tick < low])
    panel.grid(axis="y", color="0.85", linewidth=0.5)
    panel.set_axisbelow(True)
    for side in ("top", "right"):
        panel.spines[side].set_visible(False)


def _every_trial(trials: list[Row]) -> bool:
    return len(values(trials, "velocity_error")) == len(trials)
