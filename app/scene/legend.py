"""What the colours of a drawing mean, in words."""

from dataclasses import dataclass

import numpy as np

from app.analysis.comparison import A, B
from app.analysis.pairs import Pair
from app.scene.colours import Colour
from app.scene.flow_colours import WHEEL
from app.scene.settings import (
    BY_CLUSTER,
    BY_DIRECTION,
    BY_SPEED,
    STATIONARY,
    UNASSIGNED,
    ViewSettings,
)
from estimator import ClusterResult, Label

_MOST_CLUSTERS = 6


@dataclass(frozen=True)
class Mark:
    """A colour, and what has it."""

    colour: Colour
    text: str


@dataclass(frozen=True)
class Ramp:
    """Colours from one value to another, with units."""

    colours: tuple[Colour, ...]
    low: str
    high: str


@dataclass(frozen=True)
class Legend:
    """What the colours of a drawing mean.

    Attributes:
        marks: from top to bottom.
        ramp: of the arrows, None where their colours are marks.
        dark: whether the drawing's background is dark.
    """

    marks: tuple[Mark, ...] = ()
    ramp: Ramp | None = None
    dark: bool = False


def legend(
    pair: Pair | None,
    settings: ViewSettings,
    speed_limit: float,
    side: str | None = None,
    picked: ClusterResult | None = None,
) -> Legend:
    """The legend of a pair as it is drawn.

    Args:
        pair: what is drawn, None where nothing is.
        settings: of the drawing.
        speed_limit: m/s at the end of the ramp of speeds.
        side: which of A and B the pair is, where the flow of both is drawn; else None.
        picked: the cluster that is marked.
    """
    palette, layers = settings.palette, settings.layers
    if pair is None:
        return Legend(dark=settings.dark)
    marks = _source(pair, settings, side)
    if "Target" in layers:
        marks.append(Mark(palette.target, "Target"))
    ramp: Ramp | None = None
    if "Flow" in layers and side:
        marks += [Mark(palette.side(s), f"Flow of {s}: {_length(settings)}") for s in (A, B)]
    elif "Flow" in layers and pair.flow is not None:
        flow, ramp = _flow(pair, settings, speed_limit)
        marks += flow
    if "Truth" in layers and pair.object_velocity is not None:
        marks.append(Mark(palette.truth, "True velocity"))
    if "Truth ghost" in layers and pair.truth is not None and pair.truth.points is not None:
        marks.append(Mark(palette.ghost, "Source moved by the truth"))
    if picked is not None:
        marks.append(Mark(palette.picked, f"Picked: cluster {picked.index}"))
    return Legend(tuple(marks), ramp, settings.dark)


def _source(pair: Pair, settings: ViewSettings, side: str | None) -> list[Mark]:
    palette, layers = settings.palette, settings.layers
    if "Source" not in layers or pair.source is None:
        return []
    source = f"Source of {side}" if side else "Source"
    if pair.flow is None:
        return [Mark(palette.source, source)]
    marks = [Mark(palette.source, f"{source}: moving")]
    if STATIONARY in layers:
        marks.append(Mark(palette.stationary, f"{source}: stationary"))
    if UNASSIGNED in layers:
        marks.append(Mark(palette.unassigned, f"{source}: unassigned"))
    return marks


def _flow(pair: Pair, settings: ViewSettings, speed_limit: float) -> tuple[list[Mark], Ramp | None]:
    assert pair.flow is not None
    palette = settings.palette
    if settings.arrow_colours == BY_SPEED:
        return [], Ramp(palette.ramp, "Flow: 0", f"{max(speed_limit, 0.1):.1f} m/s")
    if settings.arrow_colours == BY_DIRECTION:
        # Seen from above; 0 is the x axis of the drawing.
        return [], Ramp(WHEEL, "Flow: −180°", "180° from x")
    if settings.arrow_colours == BY_CLUSTER:
        moving = np.unique(pair.flow.cluster[pair.flow.label == Label.MOVING])
        marks = [Mark(palette.category(i), f"Flow: cluster {i}") for i in map(int, moving)]
        more = len(marks) - _MOST_CLUSTERS
        rest = [Mark(palette.unassigned, f"Flow: {more} more clusters")] if more > 0 else []
        return marks[:_MOST_CLUSTERS] + rest, None
    return [Mark(palette.flow, f"Flow: {_length(settings)}")], None


def _length(settings: ViewSettings) -> str:
    return f"way in {settings.arrow_scale:g} s"
