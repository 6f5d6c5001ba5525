"""3D scene of one pair: robot, sensors, clouds, flow and truth."""

from collections.abc import Iterator
from contextlib import contextmanager

import numpy as np
from numpy.typing import NDArray

from app.analysis.comparison import A, B
from app.analysis.pairs import Pair
from app.scene.camera import Camera
from app.scene.canvas import Canvas
from app.scene.clouds_view import (
    FLOW_NODE,
    GHOST_NODE,
    SECOND_FLOW_NODE,
    SOURCE_NODE,
    STATIC_SOURCE_NODE,
    STATIC_TARGET_NODE,
    TARGET_NODE,
    TRUTH_NODE,
    CloudsView,
)
from app.scene.drawn_clouds import STATIC_SIZE, drawn_source, drawn_target
from app.scene.first_view import View
from app.scene.flow_colours import arrow_colours, faded, speed_limit
from app.scene.legend import Legend, legend
from app.scene.lens import FOV, WIDE_FOV, Lens
from app.scene.robot_view import ROOT, RobotView
from app.scene.scene_root import AXES, GRID, SceneRoot, upright
from app.scene.selection_view import SelectionView
from app.scene.sensors_view import FRUSTUMS, SENSORS, SensorsView
from app.scene.settings import ViewSettings
from app.scene.shapes import robot_shape
from app.scene.truth import ghost, truth_arrow
from app.scene.views import ROBOT, THREE_D, Projection, named_view
from estimator import ClusterResult, Label
from recordings import Recording

_NODES = {
    "Robot": (ROOT,),
    "Sensors": (SENSORS,),
    "Frustums": (FRUSTUMS,),
    "Source": (SOURCE_NODE, STATIC_SOURCE_NODE),
    "Target": (TARGET_NODE, STATIC_TARGET_NODE),
    "Flow": (FLOW_NODE, SECOND_FLOW_NODE),
    "Truth": (TRUTH_NODE,),
    "Truth ghost": (GHOST_NODE,),
    "Grid and axes": (GRID, AXES),
}
"""{layer: nodes that it shows or hides}."""

_REFERENCE_HEIGHT = 720  # pixels, the height of the picture that sizes in pixels refer to


class Scene:
    """Draws pairs of a recording on a canvas; used by one thread.

    Args:
        canvas: a browser client, or a server for exports.
        settings: initial ones.
    """

    def __init__(self, canvas: Canvas, settings: ViewSettings) -> None:
        self._canvas = canvas
        self._settings = settings
        self._robot: RobotView | None = None
        self._sensors: SensorsView | None = None
        self._selection: SelectionView | None = None
        self._shown: Pair | None = None
        self._second: Pair | None = None
        self._side = A
        self._marked: ClusterResult | None = None
        self._R_drawing_fixed = np.eye(3)
        self._speed_limit = 0.0
        self._root = SceneRoot(canvas.scene, settings.palette)
        for root in (ROOT, SENSORS, FRUSTUMS):
            canvas.scene.add_frame(root, show_axes=False)
        self._clouds = CloudsView(canvas.scene, settings.palette)
        self._clouds.size_static(STATIC_SIZE[settings.static_scene])
        self._lens: Lens | None = None
        self._show_layers()

    def open(self, recording: Recording) -> None:
        """Prepare the scene for a recording; the meshes of an identical robot are kept."""
        shape = robot_shape(recording.robot) if recording.robot else None
        if self._robot and (shape is None or shape.digest != self._robot.digest):
            self._robot.remove()
            self._robot = None
        if shape and not self._robot:
            self._robot = RobotView(self._canvas.scene, shape)
        if self._sensors:
            self._sensors.remove()
        self._sensors = SensorsView(self._canvas.scene, recording.sensors)
        self._R_drawing_fixed = upright(recording.fixed_frame)
        self._root.orient(self._R_drawing_fixed)
        self._shown = None
        self._speed_limit = 0.0

    def place_camera(self, pair: Pair, view: str = THREE_D, aspect: float = 16 / 9) -> Camera:
        """Move the camera to a named view of a pair, and return its pose.

        Args:
            pair: to be shown.
            view: name of the view.
            aspect: width by height of the picture.
        """
        placed, fov = self.view(pair, view, aspect)
        camera = Camera.of(placed.position, placed.look_at, fov)
        self.set_camera(camera)
        return camera

    def view(self, pair: Pair, name: str, aspect: float) -> tuple[View, float]:
        """Camera pose of a named view, and its vertical field of view in rad."""
        camera = self._canvas.camera
        projection = Projection(WIDE_FOV if name == ROBOT else FOV, aspect)
        before = View(np.asarray(camera.position), np.asarray(camera.look_at))
        return named_view(name, pair, self._R_drawing_fixed, projection, before), projection.fov

    @property
    def legend(self) -> Legend:
        """Legend of the current drawing."""
        side = None if self._second is None else self._side
        return legend(self._shown, self._settings, self._speed_limit, side, self._marked)

    @contextmanager
    def picture_sizes(self, view: View, fov: float, larger: float, height: int) -> Iterator[None]:
        """Context with sizes, line widths and near plane that suit a picture.

        Args:
            view: of the picture.
            fov: vertical field of view, rad.
            larger: factor on the size of points, for the picture instead of the page's window.
            height: of the picture, pixels.
        """
        lens = Lens.between(view.position, view.look_at, fov)
        gaze = view.look_at - view.position
        self._size(lens, larger)
        self._thicken(height / _REFERENCE_HEIGHT)
        try:
            eye, forward = self.in_fixed_frame(view.position), self.in_fixed_frame(gaze)
            # viser's renders ignore the camera's near plane.
            picked = [self._selection.points] if self._selection else []
            with self._clouds.clipped(eye, forward / np.linalg.norm(forward), lens.near, picked):
                yield
        finally:
            self._thicken(1.0)
            if self._lens:
                self._fit(self._lens)

    def camera(self) -> Camera:
        """Current camera."""
        camera = self._canvas.camera
        return Camera.of(np.asarray(camera.position), np.asarray(camera.look_at), camera.fov)

    def set_camera(self, camera: Camera) -> None:
        """Set the camera."""
        handle, position, look_at = self._canvas.camera, camera.position, camera.look_at
        handle.fov, handle.position, handle.look_at = camera.fov, position, look_at
        # Not read back from the handle: the browser may be reporting its old pose right now.
        self._set_lens(Lens.between(np.array(position), np.array(look_at), camera.fov))

    def adapt_sizes(self) -> None:
        """Adapt sizes to a camera that has moved; no effect before it was first placed."""
        if self._lens:
            self._set_lens(Lens.of(self._canvas.camera))

    def _set_lens(self, lens: Lens) -> None:
        if self._lens is None or not self._lens.similar(lens):
            self._lens = lens
            self._fit(lens)

    def show(
        self,
        pair: Pair,
        second: Pair | None = None,
        side: str = A,
        picked: ClusterResult | None = None,
    ) -> None:
        """Draw a pair; only changes since the last one are sent.

        Args:
            pair: to draw.
            second: pair of the same frame whose flow is drawn too, in another colour.
            side: A or B, the side of `pair` where both are drawn.
            picked: the picked cluster of the pair, None for none.
        """
        before, self._shown, self._second, self._side = self._shown, pair, second, side
        if before is None or before.target is not pair.target:
            if self._robot:
                self._robot.show(pair.link_poses)
            if self._sensors:
                self._sensors.show(pair.target.T_fixed_sensor)
        self._speed_limit = speed_limit(pair, self._speed_limit)
        self.mark(pair, picked)

    def mark(self, pair: Pair, cluster: ClusterResult | None) -> None:
        """Draw a cluster of a pair as picked and the others dimmed, or none and all as usual."""
        self._marked = cluster
        if self._selection is None and cluster is not None:
            palette = self._settings.palette
            self._selection = SelectionView(self._canvas.scene, palette, self._clouds.radius)
        if self._selection:
            self._selection.show(pair, cluster, self._R_drawing_fixed[2])
        self._show_clouds(pair)
        self._show_flow(pair)

    def in_fixed_frame(self, vector: NDArray[np.float64]) -> NDArray[np.float64]:
        """Transform a point or direction (3,) of the drawing into the recording's fixed frame."""
        return self._R_drawing_fixed.T @ vector

    def change(self, settings: ViewSettings) -> None:
        """Redraw the current pair with other settings."""
        before, self._settings = self._settings, settings
        if settings.palette != before.palette:
            self._clouds.paint(settings.palette)
            self._root.paint(settings.palette)
            if self._selection:
                self._selection.paint(settings.palette)
        if settings.static_scene != before.static_scene:
            self._clouds.size_static(STATIC_SIZE[settings.static_scene])
        if settings.point_size != before.point_size and self._lens:
            self._fit(self._lens)
        if self._shown:
            self._show_clouds(self._shown)
            self._show_flow(self._shown)
        if settings.layers != before.layers:
            self._show_layers()

    def _fit(self, lens: Lens) -> None:
        # viser does not send a value equal to the last reported one, which may be outdated: a
        # slightly different value first makes sure that the right one is sent.
        for near in (1.001 * lens.near, lens.near):
            self._canvas.camera.near = near
        self._size(lens, 1.0)

    def _size(self, lens: Lens, larger: float) -> None:
        self._clouds.fit(lens.height, larger * self._settings.point_size / _REFERENCE_HEIGHT)
        if self._selection:
            self._selection.set_point_size(self._clouds.radius)

    def _thicken(self, factor: float) -> None:
        """Multiply line widths, which are in pixels."""
        if self._sensors:
            self._sensors.thicken(factor)
        if self._selection:
            self._selection.thicken(factor)

    def _show_clouds(self, pair: Pair) -> None:
        """Draw both clouds, what does not move as the settings say, without picked points."""
        for cloud, drawn in (
            (self._clouds.target, drawn_target(pair, self._settings, self._marked)),
            (self._clouds.source, drawn_source(pair, self._settings, self._marked)),
        ):
            cloud.show(drawn.points, drawn.colours, drawn.moving)

    def _show_flow(self, pair: Pair) -> None:
        scale, palette = self._settings.arrow_scale, self._settings.palette
        seeing: list[int] = []
        if pair.source and pair.flow:
            if self._second is None:
                colours = arrow_colours(
                    pair, self._settings, self._speed_limit, self._R_drawing_fixed
                )
            else:
                colours = np.tile(
                    np.array(palette.side(self._side), np.uint8), (len(pair.flow.label), 1)
                )
            if self._marked is not None:
                faint = faded(colours, self._settings.dark)
                of_picked = pair.flow.cluster == self._marked.index
                colours = np.where(of_picked[:, None], colours, faint)
            displacement = scale * pair.interval * pair.flow.velocity
            self._clouds.show_flow(pair.source.points, displacement, colours)
            seeing = pair.source.sensor[pair.flow.label == Label.MOVING].tolist()
        else:
            none = np.zeros((0, 3))
            self._clouds.show_flow(none, none, none.astype(np.uint8))
        if self._sensors:
            self._sensors.highlight(seeing, palette)
        self._show_second_flow(scale)
        start, velocity = truth_arrow(pair, self._R_drawing_fixed[2])
        truth = None if velocity is None else scale * pair.interval * velocity
        self._clouds.show_truth(start, truth, palette.truth)
        self._clouds.show_ghost(ghost(pair))

    def _show_second_flow(self, scale: float) -> None:
        second, points, displacement = self._second, np.zeros((0, 3)), np.zeros((0, 3))
        if second and second.source and second.flow:
            points = second.source.points
            displacement = scale * second.interval * second.flow.velocity
        colour = self._settings.palette.side(B if self._side == A else A)
        self._clouds.show_second_flow(points, displacement, colour)

    def _show_layers(self) -> None:
        for layer, names in _NODES.items():
            for name in names:
                if node := self._canvas.scene.get_handle_by_name(name):
                    node.visible = layer in self._settings.layers
