"""Legend of a drawing as data, independent of how it is shown."""

from dataclasses import dataclass

import numpy as np

from app.analysis.comparison import A, B
from app.analysis.pairs import Pair
from app.scene.colours import Colour
from app.scene.flow_colours import WHEEL, faded
from app.scene.settings import (
    BY_CLUSTER,
    BY_DIRECTION,
    BY_SPEED,
    DIMMED,
    HIDDEN,
    ViewSettings,
)
from app.scene.truth import object_is_known
from estimator import ClusterResult, Label

_MOST_CLUSTERS = 6


@dataclass(frozen=True)
class LegendEntry:
    """A colour and its meaning."""

    colour: Colour
    text: str


@dataclass(frozen=True)
class Ramp:
    """Colour ramp with the texts at its ends, units included."""

    colours: tuple[Colour, ...]
    low: str
    high: str


@dataclass(frozen=True)
class Legend:
    """Meaning of the colours of a drawing.

    Attributes:
        entries: from top to bottom.
        ramp: of the arrows' colours, None unless these encode speed or direction.
        dark: whether the drawing's background is dark.
    """

    entries: tuple[LegendEntry, ...] = ()
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
        pair: that is drawn, None where none is.
        settings: of the drawing.
        speed_limit: speed at the end of the speed ramp, m/s.
        side: A or B, the side that the pair belongs to, where the flow of both is drawn; else None.
        picked: the selected cluster, None for none.
    """
    palette, layers = settings.palette, settings.layers
    if pair is None:
        return Legend(dark=settings.dark)
    entries = _source(pair, settings, side)
    if "Target" in layers:
        entries.append(LegendEntry(palette.target, "Target"))
    ramp: Ramp | None = None
    if "Flow" in layers and side:
        entries += [
            LegendEntry(palette.side(s), f"Flow of {s}: {_length(pair, settings)}") for s in (A, B)
        ]
    elif "Flow" in layers and pair.flow is not None:
        flow, ramp = _flow(pair, settings, speed_limit)
        entries += flow
    if "Truth" in layers and pair.object_velocity is not None:
        entries.append(LegendEntry(palette.truth, "True displacement"))
    if "True object" in layers and object_is_known(pair):
        entries.append(LegendEntry(palette.ghost, "True object"))
    if picked is not None:
        entries.append(LegendEntry(palette.picked, f"Picked: cluster {picked.index}"))
    return Legend(tuple(entries), ramp, settings.dark)


def _source(pair: Pair, settings: ViewSettings, side: str | None) -> list[LegendEntry]:
    palette, layers = settings.palette, settings.layers
    if "Source" not in layers or pair.source is None:
        return []
    source = f"Source of {side}" if side else "Source"
    if pair.flow is None:
        return [LegendEntry(palette.source, source)]
    entries = [LegendEntry(palette.source, f"{source}: moving")]
    if settings.static_scene != HIDDEN:
        entries.append(LegendEntry(_static(palette.stationary, settings), f"{source}: stationary"))
        entries.append(LegendEntry(_static(palette.unassigned, settings), f"{source}: unassigned"))
    return entries


def _static(colour: Colour, settings: ViewSettings) -> Colour:
    """Colour of points that do not move, as they are drawn."""
    if settings.static_scene != DIMMED:
        return colour
    r, g, b = faded(np.array([colour]), settings.background)[0].tolist()
    return r, g, b


def _flow(
    pair: Pair, settings: ViewSettings, speed_limit: float
) -> tuple[list[LegendEntry], Ramp | None]:
    assert pair.flow is not None
    palette = settings.palette
    if settings.arrow_colours == BY_SPEED:
        return [], Ramp(palette.ramp, "Flow: 0", f"{max(speed_limit, 0.1):.1f} m/s")
    if settings.arrow_colours == BY_DIRECTION:
        # Seen from above; 0 is the x axis of the drawing.
        return [], Ramp(WHEEL, "Flow: −180°", "180° from x")
    if settings.arrow_colours == BY_CLUSTER:
        moving = np.unique(pair.flow.cluster[pair.flow.label == Label.MOVING])
        entries = [LegendEntry(palette.category(i), f"Flow: cluster {i}") for i in map(int, moving)]
        more = len(entries) - _MOST_CLUSTERS
        rest = [LegendEntry(palette.unassigned, f"Flow: {more} more clusters")] if more > 0 else []
        return entries[:_MOST_CLUSTERS] + rest, None
    return [LegendEntry(palette.flow, f"Flow: {_length(pair, settings)}")], None


def _length(pair: Pair, settings: ViewSettings) -> str:
    times = "" if settings.arrow_scale == 1.0 else f"{settings.arrow_scale:g} x "
    return f"{times}displacement in {pair.interval:.2f} s"
