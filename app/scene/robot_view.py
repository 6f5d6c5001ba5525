"""Drawing of the robot: one frame per link, with the link's meshes as its children."""

from collections.abc import Mapping

import numpy as np
import viser
from numpy.typing import NDArray

from app.scene.node_poses import UNKNOWN, node_name, set_poses
from app.scene.scene_root import FIXED
from app.scene.shapes import RobotShape
from robot_assets import Transform

ROOT = f"{FIXED}/robot"


class RobotView:
    """Draws a robot; its meshes are sent once, afterwards only poses."""

    def __init__(self, scene: viser.SceneApi, shape: RobotShape) -> None:
        self._shape, self.digest = shape, shape.digest
        self._links: dict[str, viser.FrameHandle] = {}
        for number, (link, parts) in enumerate(shape.links.items()):
            node = f"{ROOT}/{node_name(number, link)}"
            self._links[link] = scene.add_frame(node, show_axes=False, visible=False)
            for index, part in enumerate(parts):
                scene.add_mesh_simple(
                    f"{node}/{index}", part.vertices, part.faces, color=part.colour
                )

    def vertices(self, link: str) -> NDArray[np.float64]:
        """All vertices (V, 3) of a link, metres in its frame."""
        parts = [part.vertices for part in self._shape.links.get(link, ())]
        return np.vstack([np.zeros((0, 3)), *parts]).astype(np.float64)

    def show(self, link_poses: Mapping[str, Transform]) -> None:
        """Move the links to their poses T_fixed_link; a link without one is hidden."""
        poses = [link_poses.get(link, UNKNOWN) for link in self._links]
        set_poses(list(self._links.values()), np.array(poses).reshape(-1, 4, 4))

    def remove(self) -> None:
        """Remove the robot from the scene."""
        for frame in self._links.values():
            frame.remove()
