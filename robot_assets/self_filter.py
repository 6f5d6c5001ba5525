"""Self filter: detection of readings of the robot's own body (paper, section II-A)."""

from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from robot_assets.raycast import RayCaster
from robot_assets.robot import Robot, Transform

# Offsets of the cast rays in zones: the centre, and towards the corners. A zone is about a tenth of
# its distance wide, and can see the body where its centre ray does not.
_FOOTPRINT = np.array([(0.0, 0.0), (-0.4, -0.4), (-0.4, 0.4), (0.4, -0.4), (0.4, 0.4)])


class SelfFilter:
    """Self filter that casts the zones' rays against the robot's posed collision meshes.

    A reading at the body or behind it is of the body, which hides everything behind it.

    Args:
        robot: its collision meshes are used.
        margin: readings up to this far in front of the body count as the body, metres.
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
        """Find the readings of the robot itself.

        Args:
            ranges: (S, R, C) metres, NaN where invalid.
            directions: (S, R, C, 3), range times direction is the point in the optical frame.
            T_base_sensor: (S, 4, 4).
            link_poses: {link: T_base_link}; links without a pose are ignored.

        Returns:
            (S, R, C), False where invalid.
        """
        import trimesh

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
    """Change of the directions for an `offset` (rows, columns) in zones; zones are equidistant."""
    down = directions[:, 1:2, :1] - directions[:, :1, :1]
    right = directions[:, :1, 1:2] - directions[:, :1, :1]
    return offset[0] * down + offset[1] * right
