"""The true object: surfaces of what moves, where they truly are."""

from collections.abc import Mapping

import numpy as np
import viser
from numpy.typing import NDArray

from app.analysis.pairs import Pair
from app.scene.node_poses import UNKNOWN, node_name, set_poses
from app.scene.palettes import Palette
from app.scene.scene_root import FIXED
from app.scene.shapes import coarse
from app.scene.truth import object_corners, object_points
from recordings import ObjectMesh

TRUE_OBJECT = f"{FIXED}/true_object"
_POINTS = f"{TRUE_OBJECT}/points"

_OPACITY = 0.4
_CELL = 0.02  # metres, size of the triangles that are sent
_POINT_SIZE = 0.8  # of a point that moves


class TrueObjectView:
    """Draws the surfaces of a simulation's moving objects at frame k.

    In other recordings, points of the source stand for them, moved by the truth.
    """

    def __init__(self, scene: viser.SceneApi, palette: Palette) -> None:
        self._scene = scene
        self._colour = palette.true_object
        self._surfaces: dict[str, viser.MeshHandle] = {}
        self._meshes: Mapping[str, ObjectMesh] = {}
        scene.add_frame(TRUE_OBJECT, show_axes=False)
        self.points = scene.add_point_cloud(
            _POINTS,
            np.zeros((0, 3)),
            palette.true_object,
            point_size=0.004,
            point_shape="circle",
            point_shading="flat",
            precision="float32",
        )

    def open(self, meshes: Mapping[str, ObjectMesh]) -> None:
        """Prepare for the objects {frame: surface} of another recording."""
        self._meshes = meshes
        for surface in self._surfaces.values():
            surface.remove()
        self._surfaces = {
            frame: self._scene.add_mesh_simple(
                f"{TRUE_OBJECT}/{node_name(number, frame)}",
                *coarse(mesh.vertices, mesh.faces, _CELL),
                color=self._colour,
                opacity=_OPACITY,
                # The far side alone: what was measured of the near side stays free.
                side="back",
                visible=False,
                cast_shadow=False,
                receive_shadow=False,
            )
            for number, (frame, mesh) in enumerate(meshes.items())
        }

    def show(self, pair: Pair) -> None:
        """Move the objects to where they are at frame k."""
        poses = [pair.object_poses.get(frame, UNKNOWN) for frame in self._surfaces]
        set_poses(list(self._surfaces.values()), np.array(poses).reshape(-1, 4, 4))
        known = any(bool(np.isfinite(pose).all()) for pose in poses)
        points = np.zeros((0, 3)) if known else object_points(pair)
        self.points.points = points.astype(np.float32)

    def corners(self, pair: Pair) -> NDArray[np.float64]:
        """Corners (8 M, 3) of boxes around the objects at frame k, in the fixed frame."""
        return object_corners(self._meshes, pair)

    def paint(self, palette: Palette) -> None:
        """Apply a palette."""
        self._colour = palette.true_object
        self.points.colors = np.array(palette.true_object, dtype=np.uint8)
        for surface in self._surfaces.values():
            surface.color = palette.true_object

    def fit(self, radius: float) -> None:
        """Set the radius of a point that moves, metres."""
        self.points.point_size = _POINT_SIZE * radius
