"""The robot: its links' meshes under frames that follow the links."""

from collections.abc import Mapping

import numpy as np
import viser

from app.scene.placing import UNKNOWN, node_name, place
from app.scene.shapes import RobotShape
from app.scene.stage import FIXED
from robot_assets import Transform

ROOT = f"{FIXED}/robot"


class RobotView:
    """Draws a robot; the meshes go to the browser once and are only moved afterwards."""

    def __init__(self, scene: viser.SceneApi, shape: RobotShape) -> None:
        self.digest = shape.digest
        self._links: dict[str, viser.FrameHandle] = {}
        for number, (link, parts) in enumerate(shape.links.items()):
            node = f"{ROOT}/{node_name(number, link)}"
            self._links[link] = scene.add_frame(node, show_axes=False, visible=False)
            for index, part in enumerate(parts):
                scene.add_mesh_simple(
                    f"{node}/{index}", part.vertices, part.faces, color=part.colour
                )

    def show(self, link_poses: Mapping[str, Transform]) -> None:
        """Move the links to their poses T_fixed_link; a link without one is hidden."""
        poses = [link_poses.get(link, UNKNOWN) for link in self._links]
        place(list(self._links.values()), np.array(poses).reshape(-1, 4, 4))

    def remove(self) -> None:
        """Take the robot out of the scene."""
        for frame in self._links.values():
            frame.remove()
