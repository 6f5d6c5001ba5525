"""Points of a pair's clouds as they are drawn: which, in which colours, which of them stand out."""

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from app.analysis.moving_targets import moving_targets
from app.analysis.pairs import Pair
from app.scene.flow_colours import faded, source_colours
from app.scene.settings import DIMMED, HIDDEN, SHOWN, ViewSettings
from estimator import ClusterResult

STATIC_SIZE = {SHOWN: 0.75, DIMMED: 0.5, HIDDEN: 0.5}
"""Size of points that do not move, as a part of those that do."""


def as_drawn(settings: ViewSettings, moves: bool) -> ViewSettings:
    """Settings of a drawing; where nothing moves, nothing is dimmed in favour of it."""
    if moves or settings.static_scene != DIMMED:
        return settings
    return replace(settings, static_scene=SHOWN)


def something_moves(pair: Pair) -> bool:
    """Whether a pair's flow moves anything."""
    return pair.flow is not None and bool(pair.flow.moving.any())


@dataclass(frozen=True)
class DrawnCloud:
    """Drawn points of a cloud.

    Attributes:
        points: (N, 3) metres.
        colours: (N, 3).
        moving: (N,) whether a point stands out: it moves, or is of the picked cluster.
    """

    points: NDArray[np.float64]
    colours: NDArray[np.uint8]
    moving: NDArray[np.bool_]


def drawn_target(pair: Pair, settings: ViewSettings, picked: ClusterResult | None) -> DrawnCloud:
    """Drawn points of a pair's target; those of a picked cluster stand out alone."""
    points = pair.target.points
    moving = moving_targets(pair) if pair.flow else np.ones(len(points), dtype=bool)
    if picked is not None:
        moving = np.zeros(len(points), dtype=bool)
        moving[picked.target] = True
    colours = np.tile(np.array(settings.palette.target, np.uint8), (len(points), 1))
    return _drawn(points, colours, moving, np.ones(len(points), dtype=bool), settings, picked)


def drawn_source(pair: Pair, settings: ViewSettings, picked: ClusterResult | None) -> DrawnCloud:
    """Drawn points of a pair's source without a picked cluster's, which are drawn as picked."""
    points = pair.source.points if pair.source else np.zeros((0, 3))
    shown = np.ones(len(points), dtype=bool)
    moving = pair.flow.moving if pair.flow else shown
    if picked is not None:
        moving = np.zeros(len(points), dtype=bool)
        shown[picked.source] = False
    return _drawn(points, source_colours(pair, settings.palette), moving, shown, settings, picked)


def _drawn(
    points: NDArray[np.float64],
    colours: NDArray[np.uint8],
    moving: NDArray[np.bool_],
    shown: NDArray[np.bool_],
    settings: ViewSettings,
    picked: ClusterResult | None,
) -> DrawnCloud:
    """The shown points, the static ones among them as the settings say."""
    if settings.static_scene == HIDDEN:
        shown = shown & moving
    elif settings.static_scene == DIMMED or picked is not None:
        colours = np.where(moving[:, None], colours, faded(colours, settings.background))
    return DrawnCloud(points[shown], colours[shown], moving[shown])
