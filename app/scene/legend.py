"""Legend of a drawing as data, independent of how it is shown."""

from dataclasses import dataclass, replace

import numpy as np

from app.analysis.comparison import A, B
from app.analysis.pairs import Pair
from app.scene.colours import Colour
from app.scene.flow_colours import WHEEL, faded
from app.scene.settings import (
    BY_CLUSTER,
    BY_DIRECTION,
    BY_SPEED,
    HIDDEN,
    SHOWN,
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
    second: Pair | None = None,
) -> Legend:
    """The legend of a pair as it is drawn.

    Args:
        pair: that is drawn, None where none is.
        settings: of the drawing.
        speed_limit: speed at the end of the speed ramp, m/s.
        side: A or B, the side that the pair belongs to, where the flow of both is drawn; else None.
        picked: the selected cluster, None for none.
        second: pair of the other side, None where the flow of one side is drawn.
    """
    palette, layers = settings.palette, settings.layers
    if pair is None:
        return Legend(dark=settings.dark)
    entries = _source(pair, settings, side, picked) + _target(pair, settings, picked)
    ramp: Ramp | None = None
    if "Flow" in layers and side:
        # Each has its own interval.
        entries += [
            LegendEntry(palette.side(s), f"Flow of {s}: {_displacement(its_pair, settings)}")
            for s, its_pair in (
                (A, pair if side == A else second),
                (B, pair if side == B else second),
            )
            if its_pair is not None
        ]
    elif "Flow" in layers and pair.flow is not None:
        flow, ramp = _flow(pair, settings, speed_limit)
        entries += flow
    if "Truth" in layers and pair.object_velocity is not None:
        times = "" if settings.arrow_scale == 1.0 else f" × {settings.arrow_scale:g}"
        entries.append(LegendEntry(palette.truth, f"True displacement{times}"))
    if "True object" in layers and object_is_known(pair):
        entries.append(LegendEntry(palette.true_object, "True object"))
    if picked is not None:
        entries.append(LegendEntry(palette.picked, f"Picked: cluster {picked.index}"))
    return Legend(tuple(entries), ramp, settings.dark)


def _source(
    pair: Pair, settings: ViewSettings, side: str | None, picked: ClusterResult | None
) -> list[LegendEntry]:
    palette = settings.palette
    if "Source" not in settings.layers or pair.source is None:
        return []
    source = f"Source of {side}" if side else "Source"
    if pair.flow is None:
        return [LegendEntry(palette.source, source)]
    moving = LegendEntry(palette.source, f"{source}: moving")
    others = [
        LegendEntry(_back(palette.stationary, settings, picked), f"{source}: stationary"),
        LegendEntry(_back(palette.unassigned, settings, picked), f"{source}: unassigned"),
    ]
    if picked is not None:
        moving = replace(moving, colour=_back(palette.source, settings, picked))
        return [] if settings.static_scene == HIDDEN else [moving, *others]
    return [moving] if settings.static_scene == HIDDEN else [moving, *others]


def _target(pair: Pair, settings: ViewSettings, picked: ClusterResult | None) -> list[LegendEntry]:
    colour = settings.palette.target
    if "Target" not in settings.layers:
        return []
    back = _back(colour, settings, picked)
    if pair.flow is None or back == colour:
        return [LegendEntry(colour, "Target")]
    clear, others = ("moving", "static") if picked is None else ("picked", "others")
    entries = [LegendEntry(colour, f"Target: {clear}"), LegendEntry(back, f"Target: {others}")]
    return entries[:1] if settings.static_scene == HIDDEN else entries


def _back(colour: Colour, settings: ViewSettings, picked: ClusterResult | None) -> Colour:
    """Colour of points that stand back, as they are drawn."""
    if settings.static_scene == SHOWN and picked is None:
        return colour
    r, g, b = faded(np.array([colour]), settings.background)[0].tolist()
    return r, g, b


def _flow(
    pair: Pair, settings: ViewSettings, speed_limit: float
) -> tuple[list[LegendEntry], Ramp | None]:
    assert pair.flow is not None
    palette, times = settings.palette, f"× {settings.arrow_scale:g}"
    title = f"Flow in {pair.interval:.2f} s {times}"
    if settings.arrow_colours == BY_SPEED:
        return [], Ramp(palette.ramp, f"{title}: 0", f"{max(speed_limit, 0.1):.1f} m/s")
    if settings.arrow_colours == BY_DIRECTION:
        # Seen from above; 0 is the x axis of the drawing.
        return [], Ramp(WHEEL, f"{title}: −180°", "180° from x")
    if settings.arrow_colours == BY_CLUSTER:
        moving = np.unique(pair.flow.cluster[pair.flow.label == Label.MOVING])
        flow = f"Flow {times}"
        entries = [
            LegendEntry(palette.category(i), f"{flow}: cluster {i}") for i in map(int, moving)
        ]
        more = len(entries) - _MOST_CLUSTERS
        rest = [LegendEntry(palette.unassigned, f"{flow}: {more} more clusters")]
        return entries[:_MOST_CLUSTERS] + (rest if more > 0 else []), None
    return [LegendEntry(palette.flow, f"Flow: {_displacement(pair, settings)}")], None


def _displacement(pair: Pair, settings: ViewSettings) -> str:
    return f"displacement in {pair.interval:.2f} s × {settings.arrow_scale:g}"
