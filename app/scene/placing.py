"""Putting a node of the scene at a pose."""

import numpy as np
import viser
import viser.transforms as vtf

from robot_assets import Transform

UNKNOWN: Transform = np.full((4, 4), np.nan)


def place(node: viser.SceneNodeHandle, pose: Transform) -> None:
    """Move a node to `pose` (4, 4) in its parent's frame; viser sends only what has changed.

    A node whose pose is not known, NaN, is hidden.
    """
    known = bool(np.isfinite(pose).all())
    if known:
        node.wxyz = vtf.SO3.from_matrix(pose[:3, :3]).wxyz
        node.position = pose[:3, 3]
    node.visible = known
