"""The ground of a vector drawing: grid, a robot's soft shadow, and the fixed frame's axes."""

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from app.analysis.pairs import Pair
from app.exports.outline import Sight
from app.exports.pinhole import Pinhole
from app.exports.strokes import Segments, draw_lines, in_front, rgb
from app.scene.colours import Colour
from app.scene.floor import SHADOW_SIZE, Foot, foot_of, lines_at, shadow_opacity
from app.scene.lens import Lens
from app.scene.scene_root import AXIS_LENGTH, AXIS_RADIUS
from app.scene.shapes import robot_shape
from recordings import Recording

if TYPE_CHECKING:
    from matplotlib.axes import Axes

_LINE = 0.3  # points
_PIECE = 0.5  # metres of a line that fade as one
_TONES = 6  # different opacities of the lines
_FADING = 1.4  # power of the lines' fading: where they are dense they must not form a grey area
_RINGS = 24  # of the shadow
_CORNERS = 64  # of a ring
_AXES = ((204, 0, 0), (0, 204, 0), (0, 0, 204))  # x, y, z as in viser


def standing(recording: Recording, pair: Pair, R_drawing_fixed: NDArray[np.float64]) -> Foot | None:
    """What a recording's robot stands on in the drawing, None without one."""
    robot = recording.robot
    pose = pair.link_poses.get(robot.base) if robot else None
    if robot is None or pose is None:
        return None
    parts = robot_shape(robot).links.get(robot.base, ())
    vertices = np.vstack([np.zeros((0, 3)), *(part.vertices for part in parts)]).astype(float)
    T_drawing_base = pose.copy()
    T_drawing_base[:3] = R_drawing_fixed @ pose[:3]
    return foot_of(vertices, T_drawing_base)


def draw_grid(
    axes: "Axes",
    pinhole: Pinhole,
    foot: Foot | None,
    colours: tuple[Colour, Colour],
    order: int,
) -> None:
    """Draw thin lines, and thick ones over them, that fade with their distance.

    Args:
        axes: of the view.
        pinhole: its camera.
        foot: the grid is at its height, through the origin without one.
        colours: of thin and thick lines.
        order: above what is drawn.
    """
    camera = pinhole.camera
    spaced, eye, near = lines_at(camera.distance), np.array(camera.position), Lens.of(camera).near
    height = 0.0 if foot is None else float(foot.centre[2])
    middle = np.zeros(2) if foot is None else foot.centre[:2]
    for step, colour in zip((spaced.thin, spaced.thick), colours, strict=True):
        lines = _grid(middle, height, step, eye, spaced.fade)
        if step == spaced.thin:
            lines = lines[~_on(lines, middle, spaced.thick)]
        for opacity, pieces in _faded(lines, eye, spaced.fade):
            places = pinhole.project(in_front(pieces, pinhole, near))[0]
            draw_lines(axes, places, (*rgb(colour), opacity), _LINE, order)


def draw_shadow(axes: "Axes", pinhole: Pinhole, foot: Foot, order: int) -> None:
    """Draw the soft shadow of what stands on the ground, as discs over each other."""
    from matplotlib.collections import PolyCollection

    angles = np.linspace(0, 2 * np.pi, _CORNERS, endpoint=False)
    circle = np.stack([np.cos(angles), np.sin(angles), np.zeros(_CORNERS)], axis=1)
    size = np.array([*(SHADOW_SIZE / 2 * foot.size), 0.0])
    parts = np.arange(1, _RINGS + 1) / _RINGS
    discs = foot.centre + (1 - (parts - 0.5 / _RINGS))[:, None, None] * size * circle
    places = pinhole.project(discs)[0]
    if not np.isfinite(places).all():
        return
    opacity = shadow_opacity(parts)
    before = np.r_[0.0, opacity[:-1]]
    added = (opacity - before) / (1 - before)
    colours = np.c_[np.zeros((_RINGS, 3)), added]
    axes.add_collection(
        PolyCollection(list(places), facecolors=colours, edgecolors="none", zorder=order),
        autolim=False,
    )


def draw_axes(
    axes: "Axes",
    pinhole: Pinhole,
    sight: Sight,
    R_drawing_fixed: NDArray[np.float64],
    order: int,
) -> None:
    """Draw the fixed frame's axes at its origin, as far as they are seen."""
    depth = float(pinhole.project(np.zeros(3))[1])
    if depth <= Lens.of(pinhole.camera).near:
        return
    scale = pinhole.height / 2 / np.tan(pinhole.camera.fov / 2) / depth
    ends = AXIS_LENGTH * R_drawing_fixed.T
    for end, colour in zip(ends, _AXES, strict=True):
        seen = sight.seen_parts(np.stack([np.zeros(3), end])[None])
        draw_lines(axes, seen, rgb(colour), 2 * AXIS_RADIUS * scale, order)


def _grid(
    middle: NDArray[np.float64],
    height: float,
    step: float,
    eye: NDArray[np.float64],
    reach: float,
) -> Segments:
    """Pieces (L, P, 2, 3) of the lines around a camera, in the order of each line."""
    lines: list[Segments] = []
    for across in (0, 1):
        along = 1 - across
        first, last = (
            np.round((eye[across] + side * reach - middle[across]) / step) for side in (-1, 1)
        )
        at = middle[across] + step * np.arange(first, last + 1)
        cuts = eye[along] + np.arange(-reach, reach + _PIECE / 2, _PIECE)
        places = np.full((len(at), len(cuts), 3), height)
        places[..., across], places[..., along] = at[:, None], cuts
        lines.append(np.stack([places[:, :-1], places[:, 1:]], axis=2))
    return np.vstack(lines)


def _on(lines: Segments, middle: NDArray[np.float64], step: float) -> NDArray[np.bool_]:
    """Mask (L,) of the lines (L, P, 2, 3) that are on a coarser grid, too."""
    begin, end = lines[:, 0, 0, :2], lines[:, -1, 1, :2]
    across = np.isclose(begin, end)
    places = (begin - middle) / step
    coarse = np.isclose(places, places.round(), atol=1e-6) & across
    return np.asarray(coarse.any(axis=1))


def _faded(
    lines: Segments, eye: NDArray[np.float64], fade: float
) -> Sequence[tuple[float, Segments]]:
    """Opacity, and what of lines (L, P, 2, 3) has it as segments (N, 2, 3)."""
    away = np.linalg.norm(lines.mean(axis=2) - eye, axis=-1)
    tone = np.round(_TONES * np.clip(1 - away / fade, 0, 1) ** _FADING).astype(int)
    # Neighbouring pieces of one tone are one.
    first = np.c_[np.ones(len(tone), bool), tone[:, 1:] != tone[:, :-1]]
    last = np.c_[first[:, 1:], np.ones(len(tone), bool)]
    merged = np.stack([lines[first][:, 0], lines[last][:, 1]], axis=1)
    tones = tone[first]
    return [(level / _TONES, merged[tones == level]) for level in range(1, _TONES + 1)]
