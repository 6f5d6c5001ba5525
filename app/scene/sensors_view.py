"""Drawing of the sensors: boxes and rings on the robot, and a frustum per field of view."""

from collections.abc import Iterable, Sequence

import numpy as np
import viser
from numpy.typing import NDArray

from app.scene.colours import FRUSTUM, SENSOR
from app.scene.node_poses import node_name, set_poses
from app.scene.palettes import Palette
from app.scene.scene_root import FIXED
from app.scene.shapes import ring_through
from recordings import RecordedSensor

SENSORS = f"{FIXED}/sensors"
FRUSTUMS = f"{FIXED}/frustums"
BODY = (
    0.018,
    0.012,
    0.010,
)  # metres, larger than the real chip so that it is visible on the robot
THICKNESS, SEEING = 0.8, 1.5
"""Line widths of frustums, pixels: usual, and where something moves in them."""
_FILLED = 0.12  # opacity of the faces of frustums in which something moves
FRUSTUM_DEPTH = 0.11  # metres from a sensor to the base of its frustum


class SensorsView:
    """Draws the sensors of a recording at their poses T_fixed_sensor."""

    def __init__(self, scene: viser.SceneApi, sensors: Sequence[RecordedSensor]) -> None:
        self._scene = scene
        self._sensors = tuple(sensors)
        self._ringed = False
        self._thicker = 1.0
        self._highlighted: dict[int, tuple[bool, Palette]] = {}  # setting a property takes time
        self._names = [node_name(index, sensor.name) for index, sensor in enumerate(sensors)]
        self._bodies = [
            scene.add_frame(f"{SENSORS}/{name}", show_axes=False, visible=False)
            for name in self._names
        ]
        for name in self._names:
            scene.add_box(
                f"{SENSORS}/{name}/body",
                color=SENSOR,
                dimensions=BODY,
                # The box lies behind the optical centre, where the chip is.
                position=(0.0, 0.0, -BODY[2] / 2),
            )
        self._frustums = [
            _add_frustum(scene, f"{FRUSTUMS}/{name}", sensor)
            for name, sensor in zip(self._names, sensors, strict=True)
        ]
        self._faces = [
            _add_faces(scene, f"{FRUSTUMS}/{name}/faces", sensor)
            for name, sensor in zip(self._names, sensors, strict=True)
        ]

    def show(self, poses: NDArray[np.float64]) -> None:
        """Move the sensors to their poses T_fixed_sensor (S, 4, 4), NaN where not known."""
        set_poses(self._bodies, poses)
        set_poses(self._frustums, poses)
        if not self._ringed and np.isfinite(poses).all():
            self._add_rings(poses)
            self._ringed = True

    def highlight(self, seeing: Iterable[int], palette: Palette) -> None:
        """Highlight the frustums of the sensors with these indices, which see something moving."""
        seeing = set(seeing)
        for index, frustum in enumerate(self._frustums):
            sees = index in seeing
            if self._highlighted.get(index) == (sees, palette):
                continue
            self._highlighted[index] = (sees, palette)
            frustum.color = palette.flow if sees else palette.frustum
            frustum.thickness = self._thicker * (SEEING if sees else THICKNESS)
            self._faces[index].visible = sees
            self._faces[index].color = palette.flow

    def thicken(self, factor: float) -> None:
        """Multiply the line width of the frustums."""
        for frustum in self._frustums:
            frustum.thickness *= factor / self._thicker
        self._thicker = factor

    def remove(self) -> None:
        """Remove the sensors from the scene."""
        for node in (*self._bodies, *self._frustums):
            node.remove()

    def _add_rings(self, poses: NDArray[np.float64]) -> None:
        """Add a torus per ring, as a child of the ring's first sensor."""
        for ring in {sensor.ring: None for sensor in self._sensors if sensor.ring}:
            members = [i for i, sensor in enumerate(self._sensors) if sensor.ring == ring]
            band = ring_through(poses[members, :3, 3])
            if band is not None:
                band.apply_transform(np.linalg.inv(poses[members[0]]))
                name = f"{SENSORS}/{self._names[members[0]]}/ring"
                self._scene.add_mesh_simple(name, band.vertices, band.faces, color=SENSOR)


def _add_frustum(
    scene: viser.SceneApi, node: str, sensor: RecordedSensor
) -> viser.CameraFrustumHandle:
    half_width, half_height = half_extents(sensor.directions)
    return scene.add_camera_frustum(
        node,
        fov=2 * float(np.arctan(half_height)),
        aspect=half_width / half_height,
        # viser scales a frustum by its volume; this scale makes it FRUSTUM_DEPTH long.
        scale=FRUSTUM_DEPTH * float(np.cbrt(half_width * half_height / 3)),
        thickness=THICKNESS,
        thickness_units="screen",
        color=FRUSTUM,
        visible=False,
        cast_shadow=False,
        receive_shadow=False,
    )


def _add_faces(scene: viser.SceneApi, node: str, sensor: RecordedSensor) -> viser.MeshHandle:
    """Faces of a frustum, a child of its lines."""
    half_width, half_height = half_extents(sensor.directions)
    corners = np.array([[-1, -1], [1, -1], [1, 1], [-1, 1]]) * [half_width, half_height]
    base = FRUSTUM_DEPTH * np.column_stack([corners, np.ones(4)])
    sides = np.array([[0, 1, 2], [0, 2, 3], [0, 3, 4], [0, 4, 1], [1, 4, 3], [1, 3, 2]])
    return scene.add_mesh_simple(
        node,
        np.vstack([np.zeros(3), base]),
        sides,
        opacity=_FILLED,
        flat_shading=True,
        side="double",
        cast_shadow=False,
        receive_shadow=False,
        visible=False,
    )


def half_extents(directions: NDArray[np.float64]) -> tuple[float, float]:
    """Half width and half height of a field of view at unit depth.

    Args:
        directions: (rows, columns, 3) through the zones' centres, in the optical frame.
    """
    rows, columns = directions.shape[:2]
    slopes = np.abs(directions[..., :2] / directions[..., 2:]).reshape(-1, 2).max(axis=0)
    # The outermost zones' centres lie half a zone inside the field of view's edge.
    width = slopes[0] * columns / max(columns - 1, 1)
    height = slopes[1] * rows / max(rows - 1, 1)
    return float(max(width, 0.01)), float(max(height, 0.01))
