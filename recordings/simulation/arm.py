"""Panda whose flange rests or is translated along a trajectory."""

from collections.abc import Mapping
from typing import TYPE_CHECKING

import numpy as np

from recordings.simulation.inverse_kinematics import FLANGE, inverse_kinematics
from recordings.simulation.trajectory import Trajectory
from robot_assets import Robot, Transform

if TYPE_CHECKING:
    from scipy.interpolate import CubicSpline

_WAYPOINT_SPACING = 0.01  # metres; the spline between them stays within micrometres of the path
_STEP = 1e-4  # seconds, of the central difference that gives velocities


class Arm:
    """Poses and velocities of a Panda's links while its flange follows a trajectory.

    Joint positions are a cubic spline through inverse kinematics at waypoints of the path, so that
    the links have smooth, exact velocities.

    Args:
        robot: a Panda.
        T_fixed_base: (4, 4) pose of its base.
        posture: {joint: rad or m} at the start of the trajectory.
        trajectory: of the flange, in the fixed frame; None where it rests.

    Raises:
        UnreachableError: the trajectory leaves the arm's reach.
    """

    def __init__(
        self,
        robot: Robot,
        T_fixed_base: Transform,
        posture: Mapping[str, float],
        trajectory: Trajectory | None,
    ) -> None:
        self._robot = robot
        self._T_fixed_base = T_fixed_base
        self._posture = {joint: posture.get(joint, 0.0) for joint in robot.joint_names}
        self._trajectory = trajectory
        self._spline = self._joints_along(trajectory) if trajectory else None

    @property
    def end(self) -> float:
        """Seconds at which its motion ends, 0 where it rests."""
        return self._trajectory.end if self._trajectory else 0.0

    def joint_positions(self, time: float) -> dict[str, float]:
        """{joint: rad or m} at `time`, seconds from the start of the recording."""
        if self._trajectory is None or self._spline is None:
            return dict(self._posture)
        values = self._spline(self._trajectory.travelled(time)).tolist()
        return dict(zip(self._posture, values, strict=True))

    def link_poses(self, time: float) -> dict[str, Transform]:
        """{link: T_fixed_link (4, 4)} at `time`."""
        return self._placed(self.joint_positions(time))

    def link_rates(self, time: float) -> dict[str, Transform]:
        """{link: the derivative (4, 4) of T_fixed_link} in 1/s and m/s at `time`, zero at rest."""
        trajectory, spline = self._trajectory, self._spline
        if trajectory is None or spline is None or not trajectory.moves(time):
            return {link: np.zeros((4, 4)) for link in self._robot.links}
        s = trajectory.travelled(time)
        now, rate = spline(s), spline(s, 1) * trajectory.speed_at(time)
        after = self._placed(dict(zip(self._posture, (now + _STEP * rate).tolist(), strict=True)))
        before = self._placed(dict(zip(self._posture, (now - _STEP * rate).tolist(), strict=True)))
        return {link: (after[link] - before[link]) / (2 * _STEP) for link in after}

    def _placed(self, positions: Mapping[str, float]) -> dict[str, Transform]:
        poses = self._robot.link_poses(positions)
        return {link: self._T_fixed_base @ pose for link, pose in poses.items()}

    def _joints_along(self, trajectory: Trajectory) -> "CubicSpline":
        from scipy.interpolate import CubicSpline

        start = self._robot.link_poses(self._posture)[FLANGE]
        count = int(np.ceil(trajectory.length / _WAYPOINT_SPACING)) + 1
        waypoints = np.linspace(0.0, trajectory.length, count)
        positions, along = dict(self._posture), []
        for travelled in waypoints.tolist():
            wanted = start.copy()
            wanted[:3, 3] += self._T_fixed_base[:3, :3].T @ trajectory.displacement(travelled)
            positions = inverse_kinematics(self._robot, positions, wanted)
            along.append(list(positions.values()))
        return CubicSpline(waypoints, np.array(along))
