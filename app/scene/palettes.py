"""Colour palettes, as in the paper or colour-blind safe, each for a light and a dark page."""

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from app.analysis.comparison import A
from app.scene.colours import FLOW, FRUSTUM, PICKED, SOURCE, TARGET, TRUTH, Colour

PAPER, COLOUR_BLIND = "As in the paper", "Colour-blind safe"
PALETTES = (PAPER, COLOUR_BLIND)
"""Names of all palettes, in the order of the list on the page."""


@dataclass(frozen=True)
class Palette:
    """The colours of one drawing.

    Attributes:
        source: of moving source points, and of all source points without an estimate.
        stationary: of source points labelled Stationary.
        unassigned: of source points labelled Unassigned.
        target: of the target.
        flow: of arrows, and of the frustums of sensors that see something moving.
        second: of B's arrows where A and B are drawn together; A's have `flow`.
        picked: of the picked cluster.
        truth: of the arrow of the true velocity.
        true_object: of the true object.
        frustum: of the sensors that see nothing moving.
        grid: of the grid's thin and thick lines.
        floor: of the plane that a robot stands on.
        categories: for clusters and other numbered things.
        ramp: stops of the sequential colour map, from low to high.
        light: brightness of the lamps, 1 for full; a dark page needs less, or colours turn pale.
    """

    source: Colour
    stationary: Colour
    unassigned: Colour
    target: Colour
    flow: Colour
    second: Colour
    picked: Colour
    truth: Colour
    true_object: Colour
    frustum: Colour
    grid: tuple[Colour, Colour]
    floor: Colour
    categories: tuple[Colour, ...]
    ramp: tuple[Colour, ...]
    light: float

    def side(self, name: str) -> Colour:
        """Colour of the flow of A or B where both are drawn."""
        return self.flow if name == A else self.second

    def category(self, index: int) -> Colour:
        """Categorical colour number `index`, repeating after the last."""
        return self.categories[index % len(self.categories)]

    def along_ramp(self, parts: NDArray[np.float64]) -> NDArray[np.uint8]:
        """Colours (N, 3) at positions (N,) along the ramp, 0 to 1."""
        return blend(self.ramp, parts)


def blend(stops: tuple[Colour, ...], parts: NDArray[np.float64]) -> NDArray[np.uint8]:
    """Colours (N, 3) at positions (N,), 0 to 1, interpolated between evenly spaced stops."""
    where = np.linspace(0.0, 1.0, len(stops))
    channels = [np.interp(parts, where, [stop[i] for stop in stops]) for i in range(3)]
    return np.stack(channels, axis=-1).round().astype(np.uint8)


_LIGHT_GRID = ((222, 226, 232), (196, 202, 212))
_DARK_GRID = ((46, 49, 56), (68, 73, 83))

# Colour-blind safe hues of Okabe and Ito, as in the second palette.
_CATEGORIES = (
    (0, 114, 178),
    (230, 159, 0),
    (0, 158, 115),
    (204, 121, 167),
    (213, 94, 0),
    (86, 180, 233),
    (120, 94, 50),
)
# Even in perceived lightness, and far from the colours of all other layers: no red, blue, orange.
_RAMP = ((72, 20, 92), (64, 60, 118), (40, 104, 128), (52, 150, 130), (150, 200, 90))
_BRIGHT_RAMP = ((128, 92, 176), (96, 124, 176), (72, 164, 172), (104, 204, 160), (196, 240, 130))

_PAPER_LIGHT = Palette(
    source=SOURCE,
    stationary=(236, 164, 160),
    unassigned=(158, 162, 170),
    target=TARGET,
    flow=FLOW,
    second=(130, 50, 200),
    picked=PICKED,
    truth=TRUTH,
    true_object=(248, 178, 92),
    frustum=FRUSTUM,
    grid=_LIGHT_GRID,
    floor=(232, 235, 240),
    categories=_CATEGORIES,
    ramp=_RAMP,
    light=1.0,
)
_PAPER_DARK = Palette(
    source=(255, 82, 76),
    stationary=(140, 66, 64),
    unassigned=(98, 102, 110),
    target=(84, 150, 255),
    flow=(60, 205, 100),
    second=(185, 120, 255),
    picked=(255, 80, 190),
    truth=(255, 160, 40),
    true_object=(190, 126, 58),
    frustum=(150, 90, 90),
    grid=_DARK_GRID,
    floor=(34, 37, 43),
    categories=_CATEGORIES,
    ramp=_BRIGHT_RAMP,
    light=0.65,
)
_ALL = {
    (PAPER, False): _PAPER_LIGHT,
    (PAPER, True): _PAPER_DARK,
    (COLOUR_BLIND, False): replace(
        _PAPER_LIGHT,
        source=(213, 94, 0),
        stationary=(240, 190, 150),
        target=(0, 114, 178),
        flow=(0, 138, 100),
        second=(95, 60, 20),
        truth=(170, 70, 130),
        true_object=(222, 170, 202),
        frustum=(160, 140, 130),
    ),
    (COLOUR_BLIND, True): replace(
        _PAPER_DARK,
        source=(255, 140, 50),
        stationary=(140, 84, 44),
        target=(86, 180, 233),
        flow=(40, 205, 155),
        second=(240, 228, 66),
        truth=(225, 140, 190),
        true_object=(150, 100, 130),
        frustum=(130, 112, 100),
    ),
}


def palette(name: str, dark: bool) -> Palette:
    """The palette of this name for a dark or a light page."""
    return _ALL[name, dark]
