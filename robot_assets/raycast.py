"""Ray casting against a triangle mesh, by Embree."""

from functools import cache
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    import trimesh

_STEP = 1e-5  # metres past a surface, above Embree's single precision at a few metres
_MAX_SURFACES = 8
_EXTENT = 100.0  # length of the diagonal that a mesh is scaled to, as trimesh does


class RayCaster:
    """Ray caster against one mesh that ignores back faces.

    A sensor mounted on a link may sit inside the link's coarse collision mesh; its rays must leave
    that mesh and still hit every other one.

    Args:
        mesh: triangles with outward normals, metres.
    """

    def __init__(self, mesh: "trimesh.Trimesh") -> None:
        from embreex.mesh_construction import TriangleMesh
        from embreex.rtcore_scene import EmbreeScene

        vertices = np.asarray(mesh.vertices)
        self._origin, self._scale = vertices.min(axis=0), _EXTENT / float(mesh.scale)
        self._scene = EmbreeScene(_device())
        TriangleMesh(self._scene, self._scaled(vertices), np.asarray(mesh.faces).astype(np.int32))
        self._normals = np.asarray(mesh.face_normals)
        self._corners = np.asarray(mesh.triangles)[:, 0]

    def cast(
        self, origins: NDArray[np.float64], directions: NDArray[np.float64]
    ) -> tuple[NDArray[np.float64], NDArray[np.int64]]:
        """Find the first front face along each ray.

        Args:
            origins: (N, 3) metres.
            directions: (N, 3) unit vectors.

        Returns:
            Distance along each ray in metres, inf where it hits nothing, and the index of the
            triangle that it hits, -1 for none: (N,) each.
        """
        distance = np.full(len(origins), np.inf)
        triangle = np.full(len(origins), -1, dtype=np.int64)
        travelled = np.zeros(len(origins))
        live = np.arange(len(origins))
        for _ in range(_MAX_SURFACES):
            if len(live) == 0:
                break
            start = origins[live] + travelled[live, None] * directions[live]
            hit = self._first(start, directions[live])
            live, start, hit = live[hit >= 0], start[hit >= 0], hit[hit >= 0]
            slope = np.einsum("ij,ij->i", self._normals[hit], directions[live])
            gap = np.einsum("ij,ij->i", self._normals[hit], self._corners[hit] - start)
            step = np.divide(gap, slope, out=np.zeros_like(gap), where=np.abs(slope) > 1e-12)
            travelled[live] += np.maximum(step, 0.0)
            front = slope < 0
            distance[live[front]] = travelled[live[front]]
            triangle[live[front]] = hit[front]
            live = live[~front]
            travelled[live] += _STEP
        return distance, triangle

    def _first(
        self, origins: NDArray[np.float64], directions: NDArray[np.float64]
    ) -> NDArray[np.int32]:
        """Index of the first triangle along each ray, -1 for none."""
        from trimesh.util import unitize

        along = np.asarray(unitize(directions.astype(np.float32)), dtype=np.float32)
        return np.asarray(self._scene.run(self._scaled(origins.astype(np.float32)), along))

    def _scaled(self, points: NDArray[Any]) -> NDArray[np.float32]:
        """Points (N, 3) in the mesh's own scale, in which single precision is enough."""
        return ((points - self._origin) * self._scale).astype(np.float32)


@cache
def _device() -> Any:  # noqa: ANN401 (embreex has no types)
    """The device of all meshes: a process that has made some thousand of them crashes."""
    from embreex.rtcore import EmbreeDevice

    return EmbreeDevice()
