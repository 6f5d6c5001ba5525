"""Self filter: detection of readings of the robot's own body (paper, section II-A)."""

from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from robot_assets.link_body import LinkBody, can_be_seen
from robot_assets.robot import Robot, Transform

# Offsets of the cast rays in zones: the centre, and towards the corners. A zone is about a tenth of
# its distance wide, and can see the body where its centre ray does not.
_FOOTPRINT = np.array([(0.0, 0.0), (-0.4, -0.4), (-0.4, 0.4), (0.4, -0.4), (0.4, 0.4)])


class SelfFilter:
    """Self filter that casts the zones' rays against the robot's collision meshes.

    A reading at the body or behind it is of the body, which hides everything behind it. Rays are
    cast in the frames of the links, whose meshes never change there, and only in those that a
    sensor can see.

    Args:
        robot: its collision meshes are used.
        directions: (S, R, C, 3), a reading times its direction is the point in the sensor's optical
            frame; NaN where a sensor has no zone.
        margin: readings up to this far in front of the body count as the body, metres.
    """

    def __init__(self, robot: Robot, directions: NDArray[np.float64], margin: float = 0.03) -> None:
        self._bodies = {
            link: LinkBody(mesh)
            for link, mesh in robot.collision_meshes.items()
            if can_be_seen(mesh)
        }
        self._margin = margin
        with np.errstate(over="ignore", invalid="ignore"):  # intrinsics may be any numbers
            steps = [_zone_steps(directions, offset) for offset in _FOOTPRINT]
            corners = np.stack([directions + step for step in steps], axis=1)
            self._lengths = np.linalg.norm(corners, axis=-1)
            # (S, 3, rays): all rays of a sensor are turned by one product of matrices.
            unit = np.moveaxis(corners / self._lengths[..., None], -1, 1)
            self._rays = np.ascontiguousarray(unit.reshape(len(directions), 3, -1))
            axis = np.nan_to_num(self._rays).sum(axis=2)
            self._axis = axis / np.linalg.norm(axis, axis=1, keepdims=True)
            along = np.einsum("si,sif->sf", self._axis, self._rays)
        self._spread = np.arccos(np.clip(np.nan_to_num(along, nan=1.0).min(axis=1), -1.0, 1.0))

    def shows_robot(
        self,
        ranges: NDArray[np.float64],
        T_base_sensor: NDArray[np.float64],
        link_poses: Mapping[str, Transform],
    ) -> NDArray[np.bool_]:
        """Find the readings of the robot itself.

        Args:
            ranges: (S, R, C) metres, NaN where invalid.
            T_base_sensor: (S, 4, 4).
            link_poses: {link: T_base_link}; links without a pose are ignored.

        Returns:
            (S, R, C), False where invalid.
        """
        reach = (ranges[:, None] * self._lengths + self._margin).reshape(len(ranges), -1)
        stopped = np.zeros(reach.shape, dtype=bool)
        R, t = T_base_sensor[:, :3, :3], T_base_sensor[:, :3, 3]
        for link, sensors in self._in_view(R, t, link_poses).items():
            T_base_link = link_poses[link]
            R_link_base = T_base_link[:3, :3].T
            stopped[sensors] |= self._bodies[link].stops(
                (t[sensors] - T_base_link[:3, 3]) @ R_link_base.T,
                (R_link_base @ R[sensors]) @ self._rays[sensors],
                reach[sensors],
            )
        return stopped.reshape(self._lengths.shape).any(axis=1)

    def _in_view(
        self,
        R_base_sensor: NDArray[np.float64],
        origins: NDArray[np.float64],
        link_poses: Mapping[str, Transform],
    ) -> dict[str, NDArray[np.int64]]:
        """{link: sensors} whose cone of rays touches the ball around the link's body."""
        links = [link for link in self._bodies if link in link_poses]
        if not links:
            return {}
        bodies = [self._bodies[link] for link in links]
        poses = np.stack([link_poses[link] for link in links])
        centres = np.stack([body.centre for body in bodies])[..., None]
        centres = (poses[:, :3, :3] @ centres)[..., 0] + poses[:, :3, 3]
        apart = centres[:, None] - origins
        distance = np.linalg.norm(apart, axis=2)
        axes = (R_base_sensor @ self._axis[..., None])[..., 0]
        # Inside of a ball, or without an axis, everything is in view: comparisons with NaN fail.
        with np.errstate(divide="ignore", invalid="ignore"):
            angle = np.arccos(np.einsum("lsi,si->ls", apart, axes) / distance)
            wide = np.arcsin(np.array([body.radius for body in bodies])[:, None] / distance)
        seen = ~(angle > self._spread + wide + 1e-6)
        return {link: np.flatnonzero(s) for link, s in zip(links, seen, strict=True) if s.any()}


def _zone_steps(
    directions: NDArray[np.float64], offset: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Change of the directions for an `offset` (rows, columns) in zones; zones are equidistant."""
    down = directions[:, 1:2, :1] - directions[:, :1, :1]
    right = directions[:, :1, 1:2] - directions[:, :1, :1]
    return offset[0] * down + offset[1] * right
