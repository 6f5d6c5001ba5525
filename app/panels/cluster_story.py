"""HTML of a pair's clusters: a table of all, and the story of one, round by round."""

from collections.abc import Callable, Sequence
from html import escape

from app.panels.tables import TableRow, framed, number, table
from app.scene.colours import css
from app.scene.palettes import Palette
from estimator import ClusterResult, IcpRound, Label, Parameters, StoryRow

_ROOM = "calc(12.6em + 6px)"  # of the cluster table: the half of a row says that it scrolls
_NO_PAIRS = "no pairs"  # in place of a fitness of 0.00


def fills(palette: Palette) -> dict[Label, str]:
    """{label: SVG fill attribute}, in the colours of the scene."""
    return {
        Label.MOVING: f'fill="{css(palette.flow)}"',
        Label.STATIONARY: f'fill="{css(palette.stationary)}"',
        Label.UNASSIGNED: f'fill="{css(palette.unassigned)}"',
    }


def cluster_table(
    clusters: Sequence[ClusterResult],
    picked: int | None,
    palette: Palette,
    attributes: Callable[[ClusterResult], str],
) -> str:
    """Table of all clusters, the picked one marked.

    Args:
        clusters: of a pair.
        picked: index of the picked one, None for none.
        palette: of the drawing.
        attributes: HTML attributes of a cluster's row, for clicks.
    """
    has_rounds = any(cluster.rounds for cluster in clusters)
    head = ("", "Points", *(("Fitness", "Displacement") if has_rounds else ()), "Label")
    rows = [
        TableRow(
            cells=(
                str(cluster.index),
                f"{len(cluster.source)} / {len(cluster.target)}",
                *(_telling_cells(cluster) if has_rounds else ()),
                f"{swatch(cluster.label, palette)}{cluster.label.name.lower()}",
            ),
            mark=palette.picked if cluster.index == picked else None,
            attributes=attributes(cluster),
        )
        for cluster in clusters
    ]
    return framed(
        f'<div style="max-height: {_ROOM}; overflow-y: auto">{table(head, rows)}</div>'
        if rows
        else "No clusters were found in this pair."
    )


def story(cluster: ClusterResult, parameters: Parameters, palette: Palette) -> str:
    """Story of a cluster: its ICP rounds with margins to the thresholds, and the outcome."""
    title = f"<b>Cluster {cluster.index}</b>: {len(cluster.source)} source and "
    title += f"{len(cluster.target)} target points"
    # The round that decides the label removes no inliers.
    removing = len(cluster.rounds) - (cluster.label != Label.UNASSIGNED)
    rows = [
        TableRow(_round_cells(count, turn, parameters, removes=count <= removing))
        for count, turn in enumerate(cluster.rounds, start=1)
    ]
    head = ("Round", "Points", "Fitness", "Displaced", "Removed")
    note = (
        '<div style="opacity: 0.65">Points: source / target. Beneath: what it is above (+) or '
        "below (−) N_min, γ and δ.</div>"
        if rows
        else ""
    )
    return framed(
        f"<div>{title}</div>{table(head, rows) if rows else ''}{note}{_own_story(cluster)}"
        f'<div style="margin: 0.3em 0">{swatch(cluster.label, palette)}'
        f"{escape(cluster.reason)}{_best_round(cluster, parameters)}</div>"
    )


def _best_round(cluster: ClusterResult, parameters: Parameters) -> str:
    """How near an unassigned cluster came to a label, whose last round is often an empty one."""
    best = telling_round(cluster)
    if best is None or cluster.label is not Label.UNASSIGNED:
        return ""
    count = next(i for i, turn in enumerate(cluster.rounds, start=1) if turn is best)
    said = f" The fitness was {best.fitness:.2f} at best, in round {count}; γ is "
    said += f"{parameters.gamma:g}."
    paired = sum(len(turn.inlier_source) for turn in cluster.rounds)
    if paired:
        said += f" {paired} of its {len(cluster.source)} source points were paired: stationary."
    return said


def swatch(label: Label, palette: Palette) -> str:
    """Small square in the label's colour."""
    return (
        '<svg width="8" height="8" style="margin-right: 0.4em">'
        f'<rect width="8" height="8" {fills(palette)[label]}/></svg>'
    )


def legend(palette: Palette) -> str:
    """Legend of the histograms: colours of the bars, and the mark."""
    labels = "".join(
        f'<span style="margin-right: 1em">{swatch(label, palette)}{label.name.lower()}</span>'
        for label in (Label.MOVING, Label.STATIONARY, Label.UNASSIGNED)
    )
    return framed(
        f"{labels}<div>Clusters, by the round that decided, or the one of the highest fitness; "
        "those without a round are left out. "
        f'<span style="color: {css(palette.picked)}">▲</span> the picked one.</div>'
    )


def telling_round(cluster: ClusterResult) -> IcpRound | None:
    """The round that decided, or the one of the highest fitness where none did; None without any.

    An unassigned cluster's last round is often left with no points, which tells nothing.
    """
    if not cluster.rounds or cluster.label is not Label.UNASSIGNED:
        return cluster.rounds[-1] if cluster.rounds else None
    return max(cluster.rounds, key=lambda turn: turn.fitness)


def _telling_cells(cluster: ClusterResult) -> tuple[str, str]:
    turn = telling_round(cluster)
    if turn is None:
        return number(None, ""), number(None, "")
    if len(turn.inlier_source) == 0:
        return _NO_PAIRS, number(None, "")
    return number(turn.fitness, ".2f"), number(turn.mean_displacement, ".3f", " m")


def _own_story(cluster: ClusterResult) -> str:
    """Table of the rows that the method itself reports on a cluster, "" without any."""
    if not cluster.story:
        return ""
    with_thresholds = any(row.threshold is not None for row in cluster.story)
    rows = [TableRow(_story_cells(row)[: 2 + with_thresholds]) for row in cluster.story]
    return table(("", "Value", "Threshold")[: 2 + with_thresholds], rows)


def _story_cells(row: StoryRow) -> tuple[str, str, str]:
    def written(value: float | str | None) -> str:
        if value is None:
            return ""
        text = value if isinstance(value, str) else f"{value:.4g}"
        return escape(f"{text} {row.unit}".strip())

    return escape(row.name), written(row.value), written(row.threshold)


def _round_cells(
    count: int, turn: IcpRound, parameters: Parameters, *, removes: bool
) -> tuple[str, ...]:
    most = max(turn.source_size, turn.target_size)
    sizes = f"{turn.source_size} / {turn.target_size}"
    points = _with_margin(sizes, most - parameters.n_min, "+d")
    if len(turn.inlier_source) == 0:
        return str(count), points, _NO_PAIRS, number(None, ""), "none"
    return (
        str(count),
        points,
        _with_margin(f"{turn.fitness:.2f}", turn.fitness - parameters.gamma, "+.2f"),
        _with_margin(
            f"{turn.mean_displacement:.3f} m", turn.mean_displacement - parameters.delta, "+.3f"
        ),
        f"{len(turn.inlier_source)} / {len(turn.inlier_target)}" if removes else "none",
    )


def _with_margin(value: str, margin: float, form: str) -> str:
    small = "opacity: 0.65; font-size: 0.9em"
    return f'{value}<div style="{small}">{number(margin, form)}</div>'
