"""Dots, lines, arrow heads and shaded areas of matplotlib, as a vector file holds them."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from app.exports.outline import Shades, Sight
from app.exports.pinhole import Pinhole
from app.scene.colours import Colour
from app.scene.lens import Lens

if TYPE_CHECKING:
    from matplotlib.axes import Axes

_TONES = (0.62, 0.78, 0.9, 1.0)
"""Brightness of the shades of a surface, of its own colour's."""

_SIZES = 16  # dots of a cloud have so many sizes at most
_FADES = 6  # different shades of what fades
_BARBS = 6  # lines of an arrow's head

Segments = NDArray[np.float64]
Rgb = tuple[float, float, float]
Rgba = tuple[float, float, float, float]


@dataclass(frozen=True)
class Fading:
    """How what is far away fades into the background.

    Attributes:
        begin: distance along the optical axis from which it fades, metres.
        end: distance at which it is all background, metres.
        background: colour.
    """

    begin: float
    end: float
    background: Colour

    def faded(self, colours: NDArray[np.uint8], depth: NDArray[np.float64]) -> NDArray[np.uint8]:
        """Colours (N, 3) of what is at distances (N,)."""
        part = np.clip((depth - self.begin) / (self.end - self.begin), 0.0, 1.0)
        # Few different colours keep a file small.
        part = (part * _FADES).round()[:, None] / _FADES
        return ((1 - part) * colours + part * np.array(self.background)).round().astype(np.uint8)


class Dots:
    """Draws points as dots whose size falls with their distance."""

    def __init__(
        self,
        axes: "Axes",
        pinhole: Pinhole,
        sight: Sight,
        R_drawing_fixed: NDArray[np.float64],
        diameter: float,
        fading: Fading | None = None,
    ) -> None:
        self._axes, self._pinhole, self._sight = axes, pinhole, sight
        self._R_drawing_fixed, self._diameter = R_drawing_fixed, diameter
        self._fading = fading
        camera = pinhole.camera
        self._lens = Lens.of(camera)

    def draw(
        self,
        clouds: Iterable[tuple[NDArray[np.float64], NDArray[np.uint8]]],
        part: float,
        order: int,
    ) -> None:
        """Draw points (N, 3) of the fixed frame in colours (N, 3), far ones first.

        Args:
            clouds: points and colours of each.
            part: their size, of a point that moves.
            order: above what is drawn.
        """
        found = list(clouds)
        if not found:
            return
        points = np.vstack([points for points, _ in found]) @ self._R_drawing_fixed.T
        colours = np.vstack([colours for _, colours in found])
        places, depth = self._pinhole.project(points)
        size = np.array([self._pinhole.width, self._pinhole.height])
        with np.errstate(invalid="ignore"):
            inside = ((places > 0) & (places < size)).all(axis=1) & (depth > self._lens.near)
        inside[inside] = self._sight.sees(points[inside])
        far = np.flatnonzero(inside)[np.argsort(-depth[inside])]
        if len(far) == 0:
            return
        diameters = part * self._diameter * self._lens.distance / depth[far]
        steps = np.geomspace(diameters.min(), max(diameters.max(), diameters.min() * 1.01), _SIZES)
        step = np.abs(diameters[:, None] - steps).argmin(axis=1)
        if self._fading is not None:
            colours[far] = self._fading.faded(colours[far], depth[far])
        # Far dots are small: those of one size and colour are drawn at once, by one shape.
        kinds, kind = np.unique(np.c_[step, colours[far]], axis=0, return_inverse=True)
        for index, (number, *colour) in enumerate(kinds.tolist()):
            self._axes.plot(
                *places[far[kind.reshape(-1) == index]].T,
                linestyle="none",
                marker="o",
                markersize=steps[number],
                markerfacecolor=rgb(colour),
                markeredgewidth=0,
                zorder=order,
            )


def head_share(segments: Segments, head: float) -> NDArray[np.float64]:
    """Length of each arrow's head, of the arrow's: a shaft must not stick out of its tip."""
    lengths = np.linalg.norm(segments[:, 1] - segments[:, 0], axis=1)
    return np.minimum(head / np.maximum(lengths, 1e-9), 0.45)


def draw_heads(axes: "Axes", lines: Segments, colours: NDArray[np.float64], order: int) -> None:
    """Fill heads whose barbs (6 N, 2, 2) are given."""
    from matplotlib.collections import PolyCollection

    heads = lines.reshape(-1, _BARBS, 2, 2)
    ends = heads[:, :, 1]
    triangles = np.stack([heads[:, :, 0], ends, np.roll(ends, -1, axis=1)], axis=2)
    axes.add_collection(
        PolyCollection(
            list(triangles.reshape(-1, 3, 2)),
            facecolors=np.repeat(colours, _BARBS, axis=0),
            edgecolors="none",
            antialiased=True,
            zorder=order,
        )
    )


def draw_lines(
    axes: "Axes", lines: Segments, colour: Rgb | Rgba | str, width: float, order: int
) -> None:
    """Draw lines (N, 2, 2) of one colour and width, points, as one path: the file stays small."""
    from matplotlib.patches import PathPatch
    from matplotlib.path import Path

    known = lines[np.isfinite(lines).all(axis=(1, 2))]
    if len(known):
        codes = np.tile([Path.MOVETO, Path.LINETO], len(known))
        path = Path(known.reshape(-1, 2).round(2), codes)
        look = {"edgecolor": colour, "linewidth": width, "capstyle": "round", "zorder": order}
        axes.add_patch(PathPatch(path, fill=False, **look))


def draw_shafts(
    axes: "Axes",
    lines: Segments,
    colours: NDArray[np.float64],
    widths: NDArray[np.float64],
    order: int,
) -> None:
    """Draw lines (N, 2, 2), each in its colour (N, 3) and of its width in points (N,)."""
    from matplotlib.collections import LineCollection

    drawn = LineCollection(list(lines), colors=colours, linewidths=widths, zorder=order)
    axes.add_collection(drawn, autolim=False)


def draw_shades(axes: "Axes", shades: Shades, dark: bool, order: int) -> None:
    """Fill the areas of each colour, from its darkest shade to its lightest."""
    dimmed = 0.75 if dark else 1.0
    lowest = shades.light[shades.colour >= 0].min(initial=1.0)
    levels = np.linspace(lowest, 1.0, len(_TONES) + 1)[:-1]
    for index, colour in enumerate(shades.colours):
        there = shades.colour == index
        if not there.any():
            continue
        for number, (level, tone) in enumerate(zip(levels, _TONES, strict=True)):
            field = there.astype(float) if number == 0 else np.where(there, shades.light, 0.0)
            if field.max() > (0.5 if number == 0 else level):
                axes.contourf(
                    shades.x,
                    shades.y,
                    field,
                    [0.5 if number == 0 else level, 2.0],
                    colors=[tuple(dimmed * tone * colour / 255)],
                    zorder=order,
                )


def draw_area(axes: "Axes", shades: Shades, colour: Rgba, order: int) -> None:
    """Fill all that a solid covers with one translucent colour."""
    there = (shades.colour >= 0).astype(float)
    if there.any():
        axes.contourf(shades.x, shades.y, there, [0.5, 2.0], colors=[colour], zorder=order)


def in_front(lines: Segments, pinhole: Pinhole, near: float) -> Segments:
    """Lines (N, 2, 3) of the drawing cut off at a camera's near plane."""
    forward = pinhole.axes[:, 2]
    depth = (lines - np.array(pinhole.camera.position)) @ forward - near
    kept = (depth > 0).any(axis=1)
    lines, depth = lines[kept], depth[kept]
    share = np.clip(depth[:, 0] / (depth[:, 0] - depth[:, 1] + 1e-12), 0.0, 1.0)[:, None]
    cut = lines[:, 0] + share * (lines[:, 1] - lines[:, 0])
    begin = np.where(depth[:, :1] > 0, lines[:, 0], cut)
    end = np.where(depth[:, 1:] > 0, lines[:, 1], cut)
    return np.stack([begin, end], axis=1)


def tiled(colour: Sequence[int], count: int) -> NDArray[np.uint8]:
    """One colour for each of so many, (N, 3)."""
    return np.tile(np.array(colour, np.uint8), (count, 1))


def rgb(colour: Sequence[int]) -> Rgb:
    """A colour as matplotlib takes it."""
    red, green, blue = colour
    return red / 255, green / 255, blue / 255
