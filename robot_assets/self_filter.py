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
        self._meshes = {
            link: (np.asarray(mesh.vertices), np.asarray(mesh.faces))
            for link, mesh in robot.collision_meshes.items()
        }
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
        shows = np.zeros(ranges.shape, dtype=bool)
        caster = self._caster(link_poses)
        if caster is None:
            return shows
        # (S, R * C, 3): matrices of a sensor at a time are multiplied several times as fast.
        flat = (len(ranges), -1, 3)
        turned = np.swapaxes(T_base_sensor[:, :3, :3], 1, 2)
        origins = np.broadcast_to(T_base_sensor[:, None, None, :3, 3], (*ranges.shape, 3))
        for offset in _FOOTPRINT:
            rest = np.isfinite(ranges) & ~shows
            shifted = directions + _zone_steps(directions, offset)
            rays = (shifted.reshape(flat) @ turned).reshape(directions.shape)[rest]
            lengths = np.linalg.norm(rays, axis=-1)
            distance, _ = caster.cast(origins[rest], rays / lengths[:, None])
            shows[rest] = ranges[rest] * lengths >= distance - self._margin
        return shows

    def _caster(self, link_poses: Mapping[str, Transform]) -> RayCaster | None:
        """The body in a pose, None where no link has one."""
        import trimesh

        vertices, faces, count = [], [], 0
        for link, (of_link, triangles) in self._meshes.items():
            if link in link_poses:
                vertices.append(trimesh.transform_points(of_link, link_poses[link]))
                faces.append(triangles + count)
                count += len(of_link)
        if not vertices:
            return None
        return RayCaster(
            trimesh.Trimesh(np.concatenate(vertices), np.concatenate(faces), process=False)
        )


def _zone_steps(
    directions: NDArray[np.float64], offset: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Change of the directions for an `offset` (rows, columns) in zones; zones are equidistant."""
    down = directions[:, 1:2, :1] - directions[:, :1, :1]
    right = directions[:, :1, 1:2] - directions[:, :1, :1]
    return offset[0] * down + offset[1] * right
