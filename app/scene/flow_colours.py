"""Colours of points by label, and of arrows by speed, direction or cluster."""

import numpy as np
from numpy.typing import NDArray

from app.analysis.pairs import Pair
from app.scene.colours import Colour
from app.scene.palettes import Palette, blend
from app.scene.settings import BY_CLUSTER, BY_DIRECTION, BY_SPEED, ViewSettings
from estimator import Label

_SPEED_STEP = 0.1  # m/s
_KEPT = 0.45  # of a colour that stands back

WHEEL: tuple[Colour, ...] = (
    (0, 145, 170),
    (40, 85, 200),
    (150, 50, 170),
    (215, 50, 70),
    (205, 125, 0),
    (90, 150, 20),
    (0, 145, 170),
)
"""Cyclic colour map of directions, from -180 to 180 degrees."""


def source_colours(pair: Pair, palette: Palette) -> NDArray[np.uint8]:
    """Colours (N, 3) of a pair's source points by label, all the same without an estimate."""
    if pair.source is None or pair.flow is None:
        size = len(pair.source.points) if pair.source else 0
        return np.tile(np.array(palette.source, dtype=np.uint8), (size, 1))
    colours = np.zeros((3, 3), dtype=np.uint8)
    colours[Label.UNASSIGNED] = palette.unassigned
    colours[Label.STATIONARY] = palette.stationary
    colours[Label.MOVING] = palette.source
    return colours[pair.flow.label]


def faded(colours: NDArray[np.uint8], background: Colour) -> NDArray[np.uint8]:
    """Colours (N, 3) of what stands back, blended with the background."""
    return (_KEPT * colours + (1 - _KEPT) * np.array(background)).round().astype(np.uint8)


def speed_limit(pair: Pair, before: float) -> float:
    """Upper end of the speed ramp in m/s: a round number, never below the one `before`."""
    if pair.flow is None:
        return before
    speeds = np.linalg.norm(pair.flow.velocity[pair.flow.label == Label.MOVING], axis=1)
    fastest = float(np.percentile(speeds, 95)) if len(speeds) else 0.0
    return max(before, _SPEED_STEP * float(np.ceil(fastest / _SPEED_STEP)))


def arrow_colours(
    pair: Pair, settings: ViewSettings, limit: float, R_drawing_fixed: NDArray[np.float64]
) -> NDArray[np.uint8]:
    """Colours (N, 3) of the source points' arrows.

    Args:
        pair: with a flow.
        settings: whose `arrow_colours` selects what is encoded.
        limit: speed at the end of the ramp, m/s.
        R_drawing_fixed: (3, 3); directions are headings in the drawing's xy plane.
    """
    assert pair.flow is not None
    velocity, palette = pair.flow.velocity, settings.palette
    if settings.arrow_colours == BY_SPEED:
        speed = np.nan_to_num(np.linalg.norm(velocity, axis=1))
        return palette.along_ramp(np.clip(speed / max(limit, _SPEED_STEP), 0.0, 1.0))
    if settings.arrow_colours == BY_DIRECTION:
        x, y, _ = np.nan_to_num(velocity @ R_drawing_fixed.T).T
        return blend(WHEEL, np.arctan2(y, x) / (2 * np.pi) + 0.5)
    if settings.arrow_colours == BY_CLUSTER:
        categories = np.array(palette.categories, dtype=np.uint8)
        return categories[pair.flow.cluster % len(categories)]
    return np.tile(np.array(palette.flow, dtype=np.uint8), (len(velocity), 1))
