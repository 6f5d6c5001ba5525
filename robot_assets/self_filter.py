"""Which readings show the robot's own body (paper, section II-A)."""

from collections.abc import Mapping

import numpy as np
import trimesh
from numpy.typing import NDArray

from robot_assets.raycast import RayCaster
from robot_assets.robot import Robot, Transform

# A zone is about a tenth of its distance wide and sees the body before its centre ray does: the
# body is tested at the centre and towards the corners of the zone.
_FOOTPRINT = np.array([(0.0, 0.0), (-0.4, -0.4), (-0.4, 0.4), (0.4, -0.4), (0.4, 0.4)])


class SelfFilter:
    """Casts the zones' rays against the robot's posed collision meshes.

    A reading that ends at the body or behind it shows the body: nothing behind it can be seen.

    Args:
        robot: whose collision meshes are cast against.
        margin: readings that end this much before the body still count as the body, metres.
    """

    def __init__(self, robot: Robot, margin: float = 0.03) -> None:
        self._meshes = robot.collision_meshes
        self._margin = margin

    def shows_robot(
        self,
        ranges: NDArray[np.float64],
        directions: NDArray[np.float64],
        T_base_sensor: NDArray[np.float64],
        link_poses: Mapping[str, Transform],
    ) -> NDArray[np.bool_]:
        """Tell which readings show the robot.

        Args:
            ranges: (S, R, C) metres, NaN where invalid.
            directions: (S, R, C, 3), range times direction is the point in the optical frame.
            T_base_sensor: (S, 4, 4).
            link_poses: {link: T_base_link}; a link without a pose is not cast against.

        Returns:
            (S, R, C), False where invalid.
        """
        shows = np.zeros(ranges.shape, dtype=bool)
        posed = [
            mesh.copy().apply_transform(link_poses[link])
            for link, mesh in self._meshes.items()
            if link in link_poses
        ]
        if not posed:
            return shows
        caster = RayCaster(trimesh.util.concatenate(posed))  # type: ignore[arg-type]
        for offset in _FOOTPRINT:
            rest = np.isfinite(ranges) & ~shows
            shifted = directions + _zone_steps(directions, offset)
            rays = np.einsum("sij,srcj->srci", T_base_sensor[:, :3, :3], shifted)[rest]
            lengths = np.linalg.norm(rays, axis=-1)
            origins = np.broadcast_to(T_base_sensor[:, None, None, :3, 3], (*ranges.shape, 3))[rest]
            distance, _ = caster.cast(origins, rays / lengths[:, None])
            shows[rest] = ranges[rest] * lengths >= distance - self._margin
        return shows


def _zone_steps(
    directions: NDArray[np.float64], offset: NDArray[np.float64]
) -> NDArray[np.float64]:
    """How far directions move by `offset` (rows, columns) of a zone, whose steps are uniform."""
    down = directions[:, 1:2, :1] - directions[:, :1, :1]
    right = directions[:, :1, 1:2] - directions[:, :1, :1]
    return offset[0] * down + offset[1] * right
