"""Body of one link: which rays meet it."""

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from robot_assets.raycast import RayCaster

if TYPE_CHECKING:
    import trimesh

_SMALLEST = 1e-6  # metres that a mesh must extend over to be seen at all
_AROUND = 1e-4  # metres from the mesh to its box: above rounding, and planes get a thickness


class LinkBody:
    """Collision mesh of a link, with a ball and a box around it that most rays pass by.

    Args:
        mesh: in the link's frame, metres.

    Attributes:
        centre: (3,) of the ball, metres.
        radius: of the ball, metres.
    """

    def __init__(self, mesh: "trimesh.Trimesh") -> None:
        self._caster = RayCaster(mesh)
        low, high = np.asarray(mesh.bounds)
        self._low, self._high = (low - _AROUND)[:, None], (high + _AROUND)[:, None]
        self.centre = (low + high) / 2
        self.radius = float(np.linalg.norm(mesh.vertices - self.centre, axis=1).max()) + _AROUND

    def stops(
        self,
        origins: NDArray[np.float64],
        directions: NDArray[np.float64],
        reach: NDArray[np.float64],
    ) -> NDArray[np.bool_]:
        """Find the rays that meet a front face of the body.

        Args:
            origins: (P, 3) metres, of bundles of rays in the link's frame.
            directions: (P, 3, F) unit vectors along each bundle's rays.
            reach: (P, F) metres along each ray up to which it counts, NaN for rays that do not.

        Returns:
            (P, F).
        """
        at = origins[:, :, None]
        # A ray along a side of the box is divided by zero: it enters at infinity or never.
        with np.errstate(divide="ignore", invalid="ignore"):
            to_low, to_high = (self._low - at) / directions, (self._high - at) / directions
            enters = np.minimum(to_low, to_high).max(axis=1)
            leaves = np.maximum(to_low, to_high).min(axis=1)
            bundle, ray = np.nonzero((enters <= np.minimum(leaves, reach)) & (leaves >= 0))
        distance, _ = self._caster.cast(origins[bundle], directions[bundle, :, ray])
        stopped = np.zeros(reach.shape, dtype=bool)
        stopped[bundle, ray] = distance <= reach[bundle, ray]
        return stopped


def can_be_seen(mesh: "trimesh.Trimesh") -> bool:
    """Whether a mesh has triangles and is not a mere point."""
    return len(mesh.faces) > 0 and bool(np.max(mesh.extents) > _SMALLEST)
