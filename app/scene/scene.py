"""What a person sees: robot, sensors, clouds and flow of one frame."""

import numpy as np
from numpy.typing import NDArray

from app.estimates import Pair
from app.scene.canvas import Canvas
from app.scene.clouds_view import FLOW_NODE, SOURCE_NODE, TARGET_NODE, TRUTH_NODE, CloudsView
from app.scene.first_view import first_view
from app.scene.robot_view import ROOT, RobotView
from app.scene.selection_view import SelectionView
from app.scene.sensors_view import FRUSTUMS, SENSORS, SensorsView
from app.scene.settings import ViewSettings
from app.scene.shapes import robot_shape
from app.scene.stage import AXES, GRID, Stage, upright
from estimator import ClusterResult
from recordings import Recording

_NODES = {
    "Robot": (ROOT,),
    "Sensors": (SENSORS,),
    "Fields of view": (FRUSTUMS,),
    "Source": (SOURCE_NODE,),
    "Target": (TARGET_NODE,),
    "Flow": (FLOW_NODE,),
    "Truth": (TRUTH_NODE,),
    "Grid and axes": (GRID, AXES),
}
"""{layer: the nodes that it switches}."""

_ABOVE = 0.12  # metres from what moves to the truth's arrow


class Scene:
    """Draws on a canvas. Everything is drawn by one thread.

    Args:
        canvas: a browser client, or what is exported without one.
        settings: to begin with.
    """

    def __init__(self, canvas: Canvas, settings: ViewSettings) -> None:
        self._canvas = canvas
        self._settings = settings
        self._robot: RobotView | None = None
        self._sensors: SensorsView | None = None
        self._selection: SelectionView | None = None
        self._shown: Pair | None = None
        self._turn = np.eye(3)
        self._stage = Stage(canvas.scene)
        for root in (ROOT, SENSORS, FRUSTUMS):
            canvas.scene.add_frame(root, show_axes=False)
        self._clouds = CloudsView(canvas.scene, settings.point_size)

    def open(self, recording: Recording) -> None:
        """Prepare the scene for a recording; a robot that looks the same is kept."""
        shape = robot_shape(recording.robot) if recording.robot else None
        if self._robot and (shape is None or shape.digest != self._robot.digest):
            self._robot.remove()
            self._robot = None
        if shape and not self._robot:
            self._robot = RobotView(self._canvas.scene, shape)
        if self._sensors:
            self._sensors.remove()
        self._sensors = SensorsView(self._canvas.scene, recording.sensors)
        self._turn = upright(recording.fixed_frame)
        self._stage.turn(self._turn)
        self._shown = None

    def place_camera(self, pair: Pair) -> None:
        """Put the camera where the pair and its sensors are seen well."""
        camera = self._canvas.camera
        poses = pair.target.T_fixed_sensor
        view = first_view(pair.target.points, poses, self._turn, camera.fov)
        camera.position = view.position
        camera.look_at = view.look_at

    def show(self, pair: Pair) -> None:
        """Draw a pair; what has not changed since the last one is not sent again."""
        before, self._shown = self._shown, pair
        if before is None or before.target is not pair.target:
            self._clouds.show_target(pair.target.points)
            if self._robot:
                self._robot.show(pair.link_poses)
            if self._sensors:
                self._sensors.show(pair.target.T_fixed_sensor)
        if before is None or before.source is not pair.source:
            self._clouds.show_source(pair.source.points if pair.source else np.zeros((0, 3)))
        self._show_flow(pair)

    def mark(self, pair: Pair, cluster: ClusterResult | None) -> None:
        """Mark a cluster of a pair as picked, or none."""
        if self._selection is None:
            if cluster is None:
                return
            self._selection = SelectionView(self._canvas.scene, self._settings.point_size)
        self._selection.show(pair, cluster, self._turn[2])

    def in_fixed_frame(self, vector: NDArray[np.float64]) -> NDArray[np.float64]:
        """A point or a direction (3,) of the drawing in the recording's fixed frame."""
        return self._turn.T @ vector

    def change(self, settings: ViewSettings) -> None:
        """Draw the same pair with other settings."""
        before, self._settings = self._settings, settings
        if settings.point_size != before.point_size:
            self._clouds.set_point_size(settings.point_size)
            if self._selection:
                self._selection.set_point_size(settings.point_size)
        if settings.arrow_scale != before.arrow_scale and self._shown:
            self._show_flow(self._shown)
        if settings.layers != before.layers:
            self._show_layers()

    def _show_flow(self, pair: Pair) -> None:
        seconds = self._settings.arrow_scale
        none = np.zeros((0, 3))
        if pair.source and pair.flow:
            self._clouds.show_flow(pair.source.points, pair.flow.velocity, seconds)
        else:
            self._clouds.show_flow(none, none, seconds)
        self._clouds.show_truth(*_truth_arrow(pair, self._turn[2]), seconds)

    def _show_layers(self) -> None:
        for layer, names in _NODES.items():
            for name in names:
                if node := self._canvas.scene.get_handle_by_name(name):
                    node.visible = layer in self._settings.layers


def _truth_arrow(
    pair: Pair, up: NDArray[np.float64]
) -> tuple[NDArray[np.float64], NDArray[np.float64] | None]:
    """Where the truth's arrow starts, just above what moves, and its velocity; (3,) each.

    Args:
        pair: whose truth it is.
        up: unit vector in the fixed frame.
    """
    velocity = pair.object_velocity
    if velocity is None or pair.source is None:
        return np.zeros(3), None
    points = pair.source.points[pair.truly_moving]
    middle = np.median(points, axis=0)
    above = float(np.percentile((points - middle) @ up, 80)) + _ABOVE
    return middle + above * up, velocity
