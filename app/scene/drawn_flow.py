"""Arrows of a pair's flow as they are drawn: where from, how far, in which colours."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from app.analysis.comparison import A, B
from app.analysis.pairs import Pair
from app.scene.flow_colours import arrow_colours, faded
from app.scene.settings import ViewSettings
from estimator import ClusterResult


@dataclass(frozen=True)
class DrawnFlow:
    """Arrows of a flow.

    Attributes:
        points: (N, 3) metres, where they begin.
        displacement: (N, 3) metres; rows of NaN have no arrow.
        colours: (N, 3).
    """

    points: NDArray[np.float64]
    displacement: NDArray[np.float64]
    colours: NDArray[np.uint8]


def drawn_flow(
    pair: Pair,
    settings: ViewSettings,
    limit: float,
    R_drawing_fixed: NDArray[np.float64],
    side: str | None = None,
    picked: ClusterResult | None = None,
) -> DrawnFlow:
    """Arrows of a pair's flow; those of other clusters than a picked one are faint.

    Args:
        pair: to draw.
        settings: of the drawing.
        limit: speed at the end of the speed ramp, m/s.
        R_drawing_fixed: (3, 3); directions are headings in the drawing's xy plane.
        side: A or B, whose colour the arrows have where the flow of both is drawn; else None.
        picked: the picked cluster, None for none.
    """
    if pair.source is None or pair.flow is None:
        return _nothing()
    points, velocity = pair.source.points, pair.flow.velocity
    if side is None:
        colours = arrow_colours(pair, settings, limit, R_drawing_fixed)
    else:
        colours = _all(settings.palette.side(side), len(points))
    if picked is not None:
        of_picked = pair.flow.cluster == picked.index
        colours = np.where(of_picked[:, None], colours, faded(colours, settings.background))
    return DrawnFlow(points, settings.arrow_scale * pair.interval * velocity, colours)


def drawn_second_flow(pair: Pair | None, settings: ViewSettings, side: str) -> DrawnFlow:
    """Arrows of the other side's pair, None for none; `side` is the edited one."""
    if pair is None or pair.source is None or pair.flow is None:
        return _nothing()
    points = pair.source.points
    displacement = settings.arrow_scale * pair.interval * pair.flow.velocity
    return DrawnFlow(
        points, displacement, _all(settings.palette.side(B if side == A else A), len(points))
    )


def moving_ends(pair: Pair) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Moving source points (M, 3), and where they went."""
    if pair.source is None or pair.flow is None:
        return np.zeros((0, 3)), np.zeros((0, 3))
    points = pair.source.points[pair.flow.moving]
    return points, points + pair.interval * pair.flow.velocity[pair.flow.moving]


def _nothing() -> DrawnFlow:
    none = np.zeros((0, 3))
    return DrawnFlow(none, none, none.astype(np.uint8))


def _all(colour: tuple[int, int, int], count: int) -> NDArray[np.uint8]:
    return np.tile(np.array(colour, np.uint8), (count, 1))
