"""The scene as lines, dots and areas of matplotlib, for vector files."""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from app.analysis.selection import points_of
from app.exports.drawn_pair import DrawnPair
from app.exports.figure_layout import LINE, text_width
from app.exports.outline import Sight
from app.exports.pinhole import Pinhole
from app.exports.solid import Solid
from app.exports.strokes import (
    Dots,
    Fading,
    Rgb,
    Segments,
    draw_area,
    draw_heads,
    draw_lines,
    draw_shades,
    draw_shafts,
    head_share,
    rgb,
    tiled,
)
from app.exports.vector_ground import draw_axes, draw_grid, draw_shadow, standing
from app.scene.arrows import barbs, shafts
from app.scene.camera import Camera
from app.scene.clouds_view import (
    HEAD,
    SHAFT,
    TRUTH_HEAD,
    TRUTH_SHAFT,
    arrows,
    has_arrow,
)
from app.scene.colours import css
from app.scene.depth import extent_of, fading
from app.scene.drawn_clouds import (
    STATIC_SIZE,
    DrawnCloud,
    as_drawn,
    drawn_source,
    drawn_target,
    something_moves,
)
from app.scene.drawn_flow import drawn_flow, drawn_second_flow
from app.scene.flow_colours import speed_limit
from app.scene.lens import Lens
from app.scene.scene_root import says_up
from app.scene.selection_view import box_around, label_text
from app.scene.sensors_view import FRUSTUM_DEPTH, SEEING, THICKNESS, half_extents
from app.scene.settings import TRANSPARENT, ViewSettings
from app.scene.surroundings import GRID_AND_AXES
from app.scene.truth import object_points, truth_arrow
from estimator import ClusterResult, Label
from recordings import Recording

if TYPE_CHECKING:
    from matplotlib.axes import Axes

_HIGH = 720  # pixels, the height of the picture that sizes in pixels refer to
_OUTLINE = 0.3  # points
_OUTLINE_INK, _BRIGHT_OUTLINE_INK = "#7d8189", "#b4b8c0"
_OBJECT_SIZE = 0.8  # of a point that moves, of those that stand for the true object
_OBJECT_OPACITY = 0.22
_PICKED_SIZE = 1.2  # of a point that moves
_LABEL_GAP = 2.5  # points between the label of a picked cluster and its box


@dataclass(frozen=True)
class VectorScene:
    """A pair's scene, ready to be drawn from any camera.

    Attributes:
        recording: of the pair.
        drawn: the pair, and what is shown with it.
        settings: of the drawing.
        R_drawing_fixed: (3, 3) from the fixed frame into the drawing's.
        solid: the robot and its sensors, None where they are not shown.
        true_object: surface of what moves, where it truly is, None where it is not shown.
        pixel: points of what is one pixel wide in a picture 720 pixels high.
    """

    recording: Recording
    drawn: DrawnPair
    settings: ViewSettings
    R_drawing_fixed: NDArray[np.float64]
    solid: Solid | None
    true_object: Solid | None
    pixel: float

    def draw(self, axes: "Axes", pinhole: Pinhole) -> None:
        """Draw the scene as a camera sees it.

        Args:
            axes: of the view, from its upper left corner in points.
            pinhole: the camera, with the view's size in points.
        """
        sight = Sight(pinhole, self.solid)
        order = iter(range(1, 100))
        grounded = GRID_AND_AXES in self.settings.layers
        if grounded and says_up(self.recording.fixed_frame):
            foot = standing(self.recording, self.drawn.pair, self.R_drawing_fixed)
            draw_grid(axes, pinhole, foot, self.settings.palette.grid, next(order))
            if foot is not None:
                draw_shadow(axes, pinhole, foot, next(order))
        if (shades := sight.shades()) is not None:
            draw_shades(axes, shades, self.settings.dark, next(order))
            lines = sight.outline()
            ink = _BRIGHT_OUTLINE_INK if self.settings.dark else _OUTLINE_INK
            draw_lines(axes, lines, ink, _OUTLINE, next(order))
        if grounded:
            draw_axes(axes, pinhole, sight, self.R_drawing_fixed, next(order))
        if "Frustums" in self.settings.layers:
            for lines, colour, width in self._frustums():
                seen = sight.seen_parts(lines @ self.R_drawing_fixed.T)
                draw_lines(axes, seen, colour, width * self.pixel, next(order))
        if self.true_object is not None:
            self._draw_true_object(axes, pinhole, next(order))
        self._draw_clouds(axes, pinhole, sight, order)

    def _draw_true_object(self, axes: "Axes", pinhole: Pinhole, order: int) -> None:
        """Draw the true object pale, so that what was measured of it stands out."""
        sight, colour = Sight(pinhole, self.true_object), rgb(self.settings.palette.true_object)
        if (shades := sight.shades()) is not None:
            draw_area(axes, shades, (*colour, _OBJECT_OPACITY), order)
            draw_lines(axes, sight.outline(), colour, _OUTLINE, order)

    def _frustums(self) -> Iterator[tuple[Segments, Rgb, float]]:
        """Lines (N, 2, 3) of the sensors' frustums in the fixed frame, colour and width each."""
        pair, palette = self.drawn.pair, self.settings.palette
        seeing: set[int] = set()
        if pair.source and pair.flow:
            seeing = set(pair.source.sensor[pair.flow.label == Label.MOVING].tolist())
        groups: dict[bool, list[Segments]] = {False: [], True: []}
        for index, sensor in enumerate(self.recording.sensors):
            pose = pair.target.T_fixed_sensor[index]
            if np.isfinite(pose).all():
                lines = _frustum(*half_extents(sensor.directions))
                groups[index in seeing].append(lines @ pose[:3, :3].T + pose[:3, 3])
        for sees, found in groups.items():
            if found:
                colour = palette.flow if sees else palette.frustum
                yield np.vstack(found), rgb(colour), SEEING if sees else THICKNESS

    def _draw_clouds(
        self, axes: "Axes", pinhole: Pinhole, sight: Sight, order: Iterator[int]
    ) -> None:
        """Draw points and arrows; what moves lies over the rest, its source over all."""
        pair, palette = self.drawn.pair, self.settings.palette
        settings = as_drawn(self.settings, something_moves(pair))
        diameter = settings.point_size * self.pixel
        fade = self._fading(pinhole.camera)
        dots = Dots(axes, pinhole, sight, self.R_drawing_fixed, diameter, fade)
        source, target = (
            drawn_cloud(pair, settings, self.drawn.picked)
            for drawn_cloud in (drawn_source, drawn_target)
        )
        shown = {"Source": source, "Target": target}
        shown = {layer: cloud for layer, cloud in shown.items() if layer in settings.layers}
        static = [_part(cloud, ~cloud.moving) for cloud in shown.values()]
        dots.draw(static, STATIC_SIZE[settings.static_scene], next(order))
        if "True object" in settings.layers and self.true_object is None:
            points = object_points(pair)
            dots.draw(
                [(points, tiled(palette.true_object, len(points)))], _OBJECT_SIZE, next(order)
            )
        if "Target" in shown:
            dots.draw([_part(target, target.moving)], 1.0, next(order))
        if "Flow" in settings.layers:
            side, picked = self.drawn.side, self.drawn.picked
            both = None if self.drawn.second is None else side
            limit = speed_limit(pair, 0.0)
            for flow in (
                drawn_second_flow(self.drawn.second, settings, side),
                drawn_flow(pair, settings, limit, self.R_drawing_fixed, both, picked),
            ):
                segments = arrows(flow.points, flow.displacement)
                colours = flow.colours[has_arrow(flow.points, flow.displacement)]
                self._draw_arrows(axes, pinhole, sight, segments, colours, (SHAFT, HEAD), order)
        if "Source" in shown:
            dots.draw([_part(source, source.moving)], 1.0, next(order))
        if self.drawn.picked is not None and pair.source is not None:
            points = pair.source.points[self.drawn.picked.source]
            dots.draw([(points, tiled(palette.picked, len(points)))], _PICKED_SIZE, next(order))
            self._draw_box(axes, pinhole, sight, self.drawn.picked, order)
        if "Truth" in settings.layers:
            start, velocity = truth_arrow(pair, self.R_drawing_fixed[2])
            if velocity is not None:
                moved = settings.arrow_scale * pair.interval * velocity
                segments = arrows(start[None], moved[None])
                sizes = (TRUTH_SHAFT, TRUTH_HEAD)
                colours = tiled(palette.truth, len(segments))
                self._draw_arrows(axes, pinhole, sight, segments, colours, sizes, order)

    def _draw_box(
        self,
        axes: "Axes",
        pinhole: Pinhole,
        sight: Sight,
        cluster: ClusterResult,
        order: Iterator[int],
    ) -> None:
        """Draw the box around a picked cluster, and its label."""
        colour = rgb(self.settings.palette.picked)
        box = box_around(points_of(self.drawn.pair, cluster)) @ self.R_drawing_fixed.T
        draw_lines(axes, sight.seen_parts(box), colour, self.pixel, next(order))
        corners = pinhole.project(box)[0].reshape(-1, 2)
        if not np.isfinite(corners).all():
            return
        text = label_text(cluster)
        edge = text_width(text) / 2 + _LABEL_GAP
        x = np.clip((corners[:, 0].min() + corners[:, 0].max()) / 2, edge, pinhole.width - edge)
        y = np.clip(corners[:, 1].min() - _LABEL_GAP, LINE, pinhole.height)
        card = {"facecolor": css(self.settings.background), "edgecolor": "none", "pad": 0.6}
        look = {"color": colour, "ha": "center", "va": "bottom", "bbox": card}
        axes.text(float(x), float(y), text, zorder=next(order), **look)

    def _fading(self, camera: Camera) -> Fading | None:
        """How the scene fades as this camera sees it; without a background it does not."""
        extent = extent_of(self.drawn.pair, self.R_drawing_fixed)
        if extent is None or self.settings.behind == TRANSPARENT:
            return None
        return Fading(*fading(extent, camera), self.settings.background)

    def _draw_arrows(
        self,
        axes: "Axes",
        pinhole: Pinhole,
        sight: Sight,
        segments: Segments,
        colours: NDArray[np.uint8],
        sizes: tuple[float, float],
        order: Iterator[int],
    ) -> None:
        """Draw arrows (N, 2, 3) of the fixed frame, far ones first; sizes of shaft and head."""
        if len(segments) == 0:
            return
        segments = segments @ self.R_drawing_fixed.T
        middles = segments.mean(axis=1)
        far = np.argsort(-pinhole.project(middles)[1])
        far = far[sight.sees(middles[far])]
        segments, colours = segments[far], colours[far]
        camera = pinhole.camera
        lens = Lens.of(camera)
        metres = lens.height / pinhole.height * self.pixel  # of a pixel, at the look-at point
        gap = self.settings.point_size * metres / 2 if sizes[0] == SHAFT else 0.0
        head = sizes[1] * _HIGH * metres
        ends, depth = pinhole.project(shafts(segments, gap))
        ends[:, 1] += (ends[:, 0] - ends[:, 1]) * 0.5 * head_share(segments, head)[:, None]
        nearness = lens.distance / np.maximum(depth.mean(axis=1), 1e-9)
        widths = sizes[0] * _HIGH * self.pixel * nearness
        draw_shafts(axes, ends, colours / 255, widths, next(order))
        draw_heads(axes, pinhole.project(barbs(segments, head))[0], colours / 255, next(order))


def _frustum(half_width: float, half_height: float) -> Segments:
    """Lines (8, 2, 3) of a frustum in its sensor's optical frame."""
    corners = FRUSTUM_DEPTH * np.array(
        [(x * half_width, y * half_height, 1.0) for x, y in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
    )
    sides = np.stack([np.zeros((4, 3)), corners], axis=1)
    base = np.stack([corners, np.roll(corners, -1, axis=0)], axis=1)
    return np.vstack([sides, base])


def _part(
    cloud: DrawnCloud, chosen: NDArray[np.bool_]
) -> tuple[NDArray[np.float64], NDArray[np.uint8]]:
    return cloud.points[chosen], cloud.colours[chosen]
