"""Inverse kinematics of a Panda by damped least squares."""

from collections.abc import Mapping

import numpy as np

from robot_assets import Robot, Transform

FLANGE = "panda_link8"
# {joint: the link it turns}; all joints of a Panda turn about the z axis of their link.
_JOINTS = {f"panda_joint{i}": f"panda_link{i}" for i in range(1, 8)}
_DAMPING = 1e-2
_TOLERANCE = 1e-6  # metres and rad
_MAX_STEPS = 200


class UnreachableError(Exception):
    """Pose of the flange that no joint positions within the limits reach."""


def inverse_kinematics(
    robot: Robot, start: Mapping[str, float], T_base_flange: Transform
) -> dict[str, float]:
    """Find joint positions near `start` that bring the flange to a pose.

    Args:
        robot: a Panda.
        start: {joint: rad or m}; joints that do not move the flange keep their values.
        T_base_flange: (4, 4) wanted pose.

    Raises:
        UnreachableError: the pose is out of reach, or beyond the joints' limits.
    """
    positions = dict(start)
    for _ in range(_MAX_STEPS):
        poses = robot.link_poses(positions)
        error = _difference(T_base_flange, poses[FLANGE])
        if np.abs(error).max() < _TOLERANCE:
            if outside := robot.outside_limits(positions, tolerance=0.0):
                raise UnreachableError(outside[0])
            return positions
        J = _jacobian(poses)
        step = J.T @ np.linalg.solve(J @ J.T + _DAMPING**2 * np.eye(6), error)
        for joint, change in zip(_JOINTS, step.tolist(), strict=True):
            positions[joint] += change
    raise UnreachableError(f"The flange does not reach {T_base_flange[:3, 3].round(3).tolist()} m.")


def _difference(wanted: Transform, current: Transform) -> np.ndarray:
    from scipy.spatial.transform import Rotation

    rotation = Rotation.from_matrix(wanted[:3, :3] @ current[:3, :3].T).as_rotvec()
    return np.concatenate([wanted[:3, 3] - current[:3, 3], rotation])


def _jacobian(poses: Mapping[str, Transform]) -> np.ndarray:
    """Jacobian (6, 7): velocity and angular velocity of the flange per joint rate, in the base."""
    flange = poses[FLANGE][:3, 3]
    axes = np.stack([poses[link][:3, 2] for link in _JOINTS.values()])
    arms = np.stack([flange - poses[link][:3, 3] for link in _JOINTS.values()])
    return np.concatenate([np.cross(axes, arms).T, axes.T])
