"""Names and poses of scene nodes."""

from collections.abc import Sequence

import numpy as np
import viser
import viser.transforms as vtf
from numpy.typing import NDArray

from robot_assets import Transform

UNKNOWN: Transform = np.full((4, 4), np.nan)


def node_name(index: int, name: str) -> str:
    """Unique name of a scene node; a slash would make it the child of another node."""
    return f"{index}_{name.replace('/', '_')}"


def set_poses(nodes: Sequence[viser.SceneNodeHandle], poses: NDArray[np.float64]) -> None:
    """Set the poses (S, 4, 4) of nodes in their parents' frames; viser sends changes only.

    A node whose pose is unknown (NaN) is hidden.
    """
    known: NDArray[np.bool_] = np.all(np.isfinite(poses), axis=(1, 2))
    turns = vtf.SO3.from_matrix(np.where(known[:, None, None], poses, np.eye(4))[:, :3, :3]).wxyz
    for i, node in enumerate(nodes):
        if known[i]:
            node.wxyz = turns[i]
            node.position = poses[i, :3, 3]
        node.visible = bool(known[i])
