"""3D scene of one pair: robot, sensors, clouds, flow and truth."""

from collections.abc import Iterator
from contextlib import contextmanager

import numpy as np
from numpy.typing import NDArray

from app.analysis.comparison import A
from app.analysis.pairs import Pair
from app.scene.camera import Camera
from app.scene.canvas import Canvas
from app.scene.clouds_view import CloudsView
from app.scene.drawn_clouds import (
    STATIC_SIZE,
    as_drawn,
    drawn_source,
    drawn_target,
    something_moves,
)
from app.scene.drawn_flow import drawn_flow, drawn_second_flow
from app.scene.first_view import View
from app.scene.flow_colours import speed_limit
from app.scene.layers import show_layers
from app.scene.legend import Legend, legend
from app.scene.lens import FOV, WIDE_FOV, Lens
from app.scene.robot_view import ROOT, RobotView
from app.scene.selection_view import SelectionView
from app.scene.sensors_view import FRUSTUMS, SENSORS, SensorsView
from app.scene.settings import ViewSettings
from app.scene.shapes import robot_shape
from app.scene.surroundings import Surroundings
from app.scene.true_object import TrueObjectView
from app.scene.truth import truth_arrow
from app.scene.views import SENSORS as FROM_SENSORS
from app.scene.views import SLANTED, Projection, named_view
from estimator import ClusterResult
from recordings import Recording

_REFERENCE_HEIGHT = 720  # pixels of the picture that sizes in pixels refer to


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
        self._speed_limit = 0.0
        self._moved = False  # ever in this recording, whose still frames must not flash up
        self._surroundings = Surroundings(canvas.scene, settings)
        for root in (ROOT, SENSORS, FRUSTUMS):
            canvas.scene.add_frame(root, show_axes=False)
        self._object = TrueObjectView(canvas.scene, settings.palette)
        self._clouds = CloudsView(canvas.scene)
        self._lens: Lens | None = None
        self._camera: Camera | None = None
        show_layers(self._canvas.scene, self._settings.layers)

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
        self._surroundings.open(recording)
        self._object.open(recording.object_meshes)
        self._shown = None
        self._speed_limit = 0.0
        self._moved = False

    def place_camera(self, pair: Pair, view: str = SLANTED, aspect: float = 16 / 9) -> Camera:
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
        projection = Projection(WIDE_FOV if name == FROM_SENSORS else FOV, aspect)
        # From amid the points what moves would be a heap.
        amid = camera.fov > (FOV + WIDE_FOV) / 2
        before = None if amid else View(np.asarray(camera.position), np.asarray(camera.look_at))
        R, objects = self._surroundings.R_drawing_fixed, self._object.corners(pair)
        return named_view(name, pair, R, projection, before, objects), projection.fov

    @property
    def legend(self) -> Legend:
        """Legend of the current drawing."""
        side = None if self._second is None else self._side
        return legend(
            self._shown, self._as_drawn, self._speed_limit, side, self._marked, self._second
        )

    @property
    def _as_drawn(self) -> ViewSettings:
        """The settings; until something moves, nothing is dimmed."""
        return as_drawn(self._settings, self._moved)

    @contextmanager
    def picture_sizes(
        self, camera: Camera, larger: float, height: int, detail: float
    ) -> Iterator[None]:
        """Context with sizes, line widths and near plane that suit a picture.

        Args:
            camera: of the picture.
            larger: factor on the size of points, for the picture instead of the page's window; text
                is larger by it already.
            height: of the picture, pixels.
            detail: pixels of what is one pixel wide in a picture 720 pixels high.
        """
        position, look_at = np.array(camera.position), np.array(camera.look_at)
        lens, before = Lens.of(camera), self._camera
        self._surroundings.fit(camera)
        gaze = look_at - position
        self._size(lens, larger, detail * _REFERENCE_HEIGHT / height)
        self._thicken(detail, detail / larger)
        try:
            eye, forward = self.in_fixed_frame(position), self.in_fixed_frame(gaze)
            # viser's renders ignore the camera's near plane.
            others = [self._object.points]
            if self._selection:
                others.append(self._selection.points)
            with self._clouds.clipped(eye, forward / np.linalg.norm(forward), lens.near, others):
                yield
        finally:
            self._thicken(1.0, 1.0)
            if self._lens and before:
                self._surroundings.fit(before)
                self._fit(self._lens)

    def camera(self) -> Camera:
        """Current camera."""
        camera = self._canvas.camera
        return Camera.of(np.asarray(camera.position), np.asarray(camera.look_at), camera.fov)

    def camera_in_fixed_frame(self) -> Camera:
        """Current camera in the recording's fixed frame."""
        return self.camera().turned(self._surroundings.R_drawing_fixed.T)

    def set_camera(self, camera: Camera) -> None:
        """Set the camera."""
        handle, position, look_at = self._canvas.camera, camera.position, camera.look_at
        handle.fov, handle.position, handle.look_at = camera.fov, position, look_at
        # Not read back from the handle: the browser may be reporting its old pose right now.
        self._adapt(camera)

    def adapt_sizes(self) -> None:
        """Adapt sizes to a camera that has moved; no effect before it was first placed."""
        if self._lens:
            self._adapt(self.camera())

    def _adapt(self, camera: Camera) -> None:
        self._camera = camera
        self._surroundings.fit(camera)
        self._fit_selection()
        lens = Lens.of(camera)
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
        self._surroundings.show(pair, self._robot)
        self._object.show(pair)
        self._speed_limit = speed_limit(pair, self._speed_limit)
        self._moved |= something_moves(pair)
        self.mark(pair, picked)

    def mark(self, pair: Pair, cluster: ClusterResult | None) -> None:
        """Draw a cluster of a pair as picked and the others dimmed, or none and all as usual."""
        self._marked = cluster
        if self._selection is None and cluster is not None:
            palette = self._settings.palette
            self._selection = SelectionView(self._canvas.scene, palette, self._clouds.radius)
        if self._selection:
            self._selection.show(pair, cluster, self._surroundings.R_drawing_fixed[2])
        self._fit_selection()
        self._show_flow(pair)
        self._show_clouds(pair)

    def _fit_selection(self) -> None:
        if self._selection and self._camera:
            self._selection.fit(self._camera.turned(self._surroundings.R_drawing_fixed.T))

    def in_fixed_frame(self, vector: NDArray[np.float64]) -> NDArray[np.float64]:
        """Transform a point or direction (3,) of the drawing into the recording's fixed frame."""
        return self._surroundings.R_drawing_fixed.T @ vector

    def change(self, settings: ViewSettings) -> None:
        """Redraw the current pair with other settings."""
        before, self._settings = self._settings, settings
        self._surroundings.change(settings)
        if settings.palette != before.palette:
            self._object.paint(settings.palette)
            if self._selection:
                self._selection.paint(settings.palette)
        if settings.point_size != before.point_size and self._lens:
            self._fit(self._lens)
        if self._shown:
            self._show_clouds(self._shown)
            self._show_flow(self._shown)
        if settings.layers != before.layers:
            show_layers(self._canvas.scene, self._settings.layers)

    def _fit(self, lens: Lens) -> None:
        # viser does not send a value equal to the last reported one, which may be outdated: a
        # slightly different value first makes sure that the right one is sent.
        for near in (1.001 * lens.near, lens.near):
            self._canvas.camera.near = near
        self._size(lens, 1.0, 1.0)

    def _size(self, lens: Lens, larger: float, magnified: float) -> None:
        """Set sizes for a lens.

        Args:
            lens: of the camera.
            larger: factor on the size of points alone.
            magnified: factor on the size of points and arrows.
        """
        point_size = larger * self._settings.point_size / _REFERENCE_HEIGHT
        self._clouds.fit(magnified * lens.height, point_size)
        self._object.fit(self._clouds.radius)
        if self._selection:
            self._selection.set_point_size(self._clouds.radius)

    def _thicken(self, factor: float, text: float) -> None:
        """Multiply line widths, which are in pixels, and the size of text."""
        if self._sensors:
            self._sensors.thicken(factor)
        if self._selection:
            self._selection.thicken(factor, text)

    def _show_clouds(self, pair: Pair) -> None:
        """Draw both clouds, what does not move as the settings say, without picked points."""
        settings = self._as_drawn
        self._clouds.size_static(STATIC_SIZE[settings.static_scene])
        for cloud, drawn in (
            (self._clouds.target, drawn_target(pair, settings, self._marked)),
            (self._clouds.source, drawn_source(pair, settings, self._marked)),
        ):
            cloud.show(drawn.points, drawn.colours, drawn.moving)

    def _show_flow(self, pair: Pair) -> None:
        settings, R = self._settings, self._surroundings.R_drawing_fixed
        side = None if self._second is None else self._side
        flow = drawn_flow(pair, settings, self._speed_limit, R, side, self._marked)
        self._clouds.show_flow(flow)
        self._clouds.show_second_flow(drawn_second_flow(self._second, settings, self._side))
        if self._sensors:
            moving = pair.source.sensor[pair.flow.moving] if pair.source and pair.flow else ()
            self._sensors.highlight(map(int, moving), settings.palette)
        start, velocity = truth_arrow(pair, R[2])
        truth = None if velocity is None else settings.arrow_scale * pair.interval * velocity
        self._clouds.show_truth(start, truth, settings.palette.truth)
