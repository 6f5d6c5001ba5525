"""Drawing of what a person looks at: rays and points of zones, the selected sensor's frustum."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import viser
from numpy.typing import NDArray

from app.scene.camera import Camera
from app.scene.colours import Colour
from app.scene.lens import Lens, aspect_of
from app.scene.node_poses import set_poses
from app.scene.scene_root import FIXED
from app.scene.sensors_view import FRUSTUM_DEPTH, half_extents
from recordings import RecordedSensor

RAYS_NODE = f"{FIXED}/pointer/rays"
POINTS_NODE = f"{FIXED}/pointer/points"
SELECTED_NODE = f"{FIXED}/selected_sensor"

_SIZE = 0.0075  # radius of a marked point, of the picture's height
_SAME_SIZE = 0.05  # relative change of a radius that is not worth sending
_RAY, _FRUSTUM = 2.0, 3.5  # line widths, pixels
_LONGER = 1.25  # depth of the selected sensor's frustum, relative to the others


@dataclass(frozen=True)
class Mark:
    """A marked zone.

    Attributes:
        start: (3,) of its ray in the fixed frame, metres.
        end: (3,) of its ray, likewise.
        hit: whether the ray ends at a point.
        colour: of both.
    """

    start: NDArray[np.float64]
    end: NDArray[np.float64]
    hit: bool
    colour: Colour


class PointerView:
    """Marks zones by their rays and points, and a sensor by a larger frustum.

    Args:
        client: owner of the scene.
    """

    def __init__(self, client: viser.ClientHandle) -> None:
        self._client, self._scene, self._camera = client, client.scene, client.camera
        self._rays: viser.LineSegmentsHandle | None = None
        self._points: viser.PointCloudHandle | None = None
        self._frustum: viser.CameraFrustumHandle | None = None
        self._sensor: RecordedSensor | None = None

    @property
    def near(self) -> float:
        """Distance of the camera's near plane, metres."""
        return self._camera.near

    @property
    def fov(self) -> float:
        """The camera's vertical field of view, rad."""
        return self._camera.fov

    @property
    def aspect(self) -> float:
        """Width by height of the scene in the page."""
        return aspect_of(self._camera)

    def adapt_size(self) -> None:
        """Adapt the size of marked points to a camera that has moved."""
        if self._points is not None:
            camera = self._camera
            eye, gaze = np.asarray(camera.position), np.asarray(camera.look_at)
            radius = _SIZE * Lens.of(Camera.of(eye, gaze, camera.fov)).height
            if abs(radius / self._points.point_size - 1) > _SAME_SIZE:
                self._points.point_size = radius

    def mark(self, marks: Sequence[Mark]) -> None:
        """Draw these marks in place of those before; nothing is made before the first."""
        if self._rays is None or self._points is None:
            if not marks:
                return
            self._rays, self._points = self._make()
        segments = [(mark.start, mark.end) for mark in marks]
        colours = np.array([mark.colour for mark in marks], dtype=np.uint8).reshape(-1, 3)
        hit = np.array([mark.hit for mark in marks], dtype=bool)
        drawn = np.array(segments, dtype=np.float32).reshape(-1, 2, 3)
        with self._client.atomic():
            self._rays.points, self._rays.colors = drawn, np.repeat(colours[:, None], 2, axis=1)
            self._points.visible = bool(hit.any())
            if hit.any():
                self._points.points, self._points.colors = drawn[hit, 1], colours[hit]
        self.adapt_size()

    def select(
        self, sensor: RecordedSensor | None, pose: NDArray[np.float64], colour: Colour
    ) -> None:
        """Draw the frustum of a sensor at its pose (4, 4), NaN where unknown, or of none."""
        if sensor is not self._sensor:
            if self._frustum is not None:
                self._frustum.remove()
                self._frustum = None
            self._sensor = sensor
            if sensor is not None:
                self._frustum = self._add_frustum(sensor)
        if self._frustum is not None:
            self._frustum.color = colour
            set_poses([self._frustum], pose[None])

    def _make(self) -> tuple[viser.LineSegmentsHandle, viser.PointCloudHandle]:
        rays = self._scene.add_line_segments(
            RAYS_NODE,
            np.zeros((0, 2, 3), dtype=np.float32),
            np.zeros((0, 2, 3), dtype=np.uint8),
            thickness=_RAY,
            thickness_units="screen",
        )
        points = self._scene.add_point_cloud(
            POINTS_NODE,
            np.zeros((1, 3), dtype=np.float32),  # the page takes no empty list of colours
            np.zeros((1, 3), dtype=np.uint8),
            point_size=0.01,
            point_shape="circle",
            point_shading="flat",
            precision="float32",
            visible=False,
        )
        return rays, points

    def _add_frustum(self, sensor: RecordedSensor) -> viser.CameraFrustumHandle:
        half_width, half_height = half_extents(sensor.directions)
        return self._scene.add_camera_frustum(
            SELECTED_NODE,
            fov=2 * float(np.arctan(half_height)),
            aspect=half_width / half_height,
            scale=_LONGER * FRUSTUM_DEPTH * float(np.cbrt(half_width * half_height / 3)),
            thickness=_FRUSTUM,
            thickness_units="screen",
            cast_shadow=False,
            receive_shadow=False,
        )
