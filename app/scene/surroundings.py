"""Surroundings of what is drawn: lights, the fixed frame, the floor, and what fades far away."""

import numpy as np
import viser
from numpy.typing import NDArray

from app.analysis.pairs import Pair
from app.scene.camera import Camera
from app.scene.depth import Depth, extent_of
from app.scene.drawn_flow import moving_ends
from app.scene.floor import Floor, foot_of
from app.scene.robot_view import RobotView
from app.scene.scene_root import SceneRoot, says_up, upright
from app.scene.settings import SOFT, TRANSPARENT, ViewSettings
from recordings import Recording

GRID_AND_AXES = "Grid and axes"
"""Layer of the floor, and of the fixed frame's axes."""


class Surroundings:
    """Lights, fixed frame, floor and depth of a drawing.

    Attributes:
        R_drawing_fixed: (3, 3), from the fixed frame into the drawing, whose z axis points up.
    """

    def __init__(self, scene: viser.SceneApi, settings: ViewSettings) -> None:
        self.R_drawing_fixed: NDArray[np.float64] = np.eye(3)
        self._root = SceneRoot(scene, settings.palette)
        self._floor = Floor(scene, settings.palette)
        self._depth = Depth(scene)
        self._camera: Camera | None = None
        self._base: str | None = None
        self._standing = False
        self.change(settings)

    def open(self, recording: Recording) -> None:
        """Prepare for a recording."""
        self.R_drawing_fixed = upright(recording.fixed_frame)
        self._root.orient(self.R_drawing_fixed)
        self._floor.know_up(says_up(recording.fixed_frame))
        self._base = recording.robot.base if recording.robot else None
        self._standing = False

    def show(self, pair: Pair, robot: RobotView | None) -> None:
        """Suit a pair, of whose recording the first one says where the robot stands."""
        if not self._standing:
            self._stand(pair, robot)
        self._floor.show(np.vstack(moving_ends(pair)) @ self.R_drawing_fixed.T)
        self._depth.show(extent_of(pair, self.R_drawing_fixed))
        if self._camera:
            self._depth.fit(self._camera)

    def fit(self, camera: Camera) -> None:
        """Suit another camera."""
        self._camera = camera
        self._depth.fit(camera)
        self._floor.fit(camera.distance)

    def change(self, settings: ViewSettings) -> None:
        """Apply other settings."""
        self._root.paint(settings.palette)
        self._floor.paint(settings.palette)
        self._floor.want(GRID_AND_AXES in settings.layers)
        self._floor.make_solid(settings.behind == SOFT)
        self._depth.paint(settings.background, settings.behind != TRANSPARENT)
        if self._camera:
            self._depth.fit(self._camera)

    def _stand(self, pair: Pair, robot: RobotView | None) -> None:
        self._standing = True
        base = None if self._base is None else pair.link_poses.get(self._base)
        if robot is None or self._base is None or base is None:
            self._floor.stand(None)
            return
        T_drawing_base = base.copy()
        T_drawing_base[:3] = self.R_drawing_fixed @ base[:3]
        self._floor.stand(foot_of(robot.vertices(self._base), T_drawing_base))
