"""Ray casting of a rig's zones into the scene, several rays per zone."""

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from recordings.simulation.edges import Edges, ZoneHits, edges
from robot_assets import RayCaster, Rig, SensorModel, zone_rays

if TYPE_CHECKING:
    import trimesh

_SUB_RAYS = 4  # along each side of a zone
_FAR = 1e3  # metres, in place of inf for rays that hit nothing


@dataclass(frozen=True)
class Hits:
    """Hits of a bundle of rays.

    Attributes:
        distance: metres along each ray, inf where it hits nothing.
        piece: index of the mesh that it hits, -1 for none.
    """

    distance: NDArray[np.float64]
    piece: NDArray[np.int64]

    def nearest(self, other: "Hits") -> "Hits":
        """The nearer of the two hits of each ray."""
        nearer = self.distance <= other.distance
        return Hits(
            np.where(nearer, self.distance, other.distance),
            np.where(nearer, self.piece, other.piece),
        )


class PieceCaster:
    """Ray caster against several meshes at once that returns the index of the mesh hit.

    Args:
        pieces: {index: mesh in the fixed frame}.
    """

    def __init__(self, pieces: "dict[int, trimesh.Trimesh]") -> None:
        import trimesh

        self._caster = RayCaster(trimesh.util.concatenate(list(pieces.values())))  # type: ignore[arg-type]
        # The last entry is for rays that hit no triangle, whose index is -1.
        self._piece = np.concatenate(
            [*(np.full(len(mesh.faces), index) for index, mesh in pieces.items()), [-1]]
        )

    def cast(self, origins: NDArray[np.float64], directions: NDArray[np.float64]) -> Hits:
        """Find the first front face along each ray: origins (N, 3) metres, unit directions."""
        distance, triangle = self._caster.cast(origins, directions)
        return Hits(distance, self._piece[triangle])


class ZoneRays:
    """Rays of all zones of a rig, an even grid over each zone's footprint.

    Args:
        rig: the sensors.
    """

    def __init__(self, rig: Rig) -> None:
        rays = _sub_rays(rig.model)
        # From depth to distance along the zone's ray; 1 for sensors that report depth.
        self._slant = 1.0 / rig.model.directions[..., 2:]
        self._lengths = np.linalg.norm(rays, axis=-1)
        self._directions = rays / self._lengths[..., None]

    def in_fixed(
        self, T_fixed_sensor: NDArray[np.float64]
    ) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """Origins and unit directions (N, 3) of all rays for sensor poses (S, 4, 4)."""
        R, t = T_fixed_sensor[:, :3, :3], T_fixed_sensor[:, :3, 3]
        directions = np.einsum("sij,rcnj->srcni", R, self._directions)
        origins = np.broadcast_to(t[:, None, None, None, :], directions.shape)
        return origins.reshape(-1, 3), directions.reshape(-1, 3)

    def seen(self, hits: Hits) -> ZoneHits:
        """Surface that each zone measures: the mesh that fills most of its footprint.

        The sensor reports the strongest return. Of equally large meshes it is the nearest; the
        distance is the mean over the rays that hit it.
        """
        distance, piece = self._by_zone(hits)
        same = piece[..., :, None] == piece[..., None, :]
        near = np.minimum(distance, _FAR) / (2 * _FAR)
        strongest = np.argmax(same.sum(axis=-1) - near, axis=-1)[..., None]
        piece_seen = np.take_along_axis(piece, strongest, axis=-1)
        mine = piece == piece_seen
        total = np.where(mine, self._measured(distance), 0.0).sum(axis=-1)
        return ZoneHits(total / mine.sum(axis=-1), piece_seen[..., 0])

    def edges(self, hits: Hits) -> Edges:
        """Depth discontinuities within zones."""
        distance, piece = self._by_zone(hits)
        return edges(self._measured(distance), piece)

    def _by_zone(self, hits: Hits) -> tuple[NDArray[np.float64], NDArray[np.int64]]:
        """Distances along the rays and mesh indices, both (S, rows, columns, n * n)."""
        shape = (-1, *self._lengths.shape)
        return hits.distance.reshape(shape), hits.piece.reshape(shape)

    def _measured(self, distance: NDArray[np.float64]) -> NDArray[np.float64]:
        """Convert distances along the rays to those that the sensor reports for the zones."""
        return distance / self._lengths * self._slant


def _sub_rays(model: SensorModel) -> NDArray[np.float64]:
    """(rows, columns, n * n, 3) in the optical frame, each with z = 1."""
    n = _SUB_RAYS
    fx, fy = n * model.focal_length, n * model.vertical_focal_length
    rows, columns = n * model.rows, n * model.columns
    fine = zone_rays(rows, columns, fx, fy, 0.5 * (columns - 1), 0.5 * (rows - 1))
    blocks = fine.reshape(model.rows, n, model.columns, n, 3).swapaxes(1, 2)
    return blocks.reshape(model.rows, model.columns, n * n, 3)
