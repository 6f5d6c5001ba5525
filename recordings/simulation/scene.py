"""The scene of a scenario: both robots, the mannequin and the lab, at any time."""

from dataclasses import dataclass

import numpy as np
import trimesh
from numpy.typing import NDArray

from recordings.simulation.arm import Arm
from recordings.simulation.glide import REST, Glide
from recordings.simulation.inverse_kinematics import FLANGE, inverse_kinematics
from recordings.simulation.mannequin import GRIP, mannequin
from recordings.simulation.scenario import Scenario
from recordings.simulation.surroundings import surroundings
from robot_assets import Robot, Transform

SURROUNDINGS, MANNEQUIN, OWN_ROBOT, SECOND_ROBOT = 0, 1, 2, 3
"""Numbers of objects in the truth; the links of the second robot follow from SECOND_ROBOT on."""

# Where the middle of the mannequin's chest starts, in the fixed frame. Its front is then 0.75 m
# from the robot's axis, as the distance in the paper is understood here.
_MANNEQUIN_PLACE = np.array([0.0, 0.885, 0.43])
# The second robot stands behind it, and looks at the first one.
_SECOND_ROBOT_PLACE = np.array([0.0, 1.485, 0.0])
_SECOND_POSTURE = (0.0, -0.4, 0.0, -2.3, 0.0, 2.75, np.pi / 4)
_FINGERS = 0.105  # metres from the flange to what the fingers hold
_JOINTS = tuple(f"panda_joint{i}" for i in range(1, 8))


@dataclass(frozen=True)
class Body:
    """Something that may move: a mesh at a pose, and how the pose changes.

    Attributes:
        number: of its object in the truth.
        mesh: in its own frame, metres.
        T_fixed_body: (4, 4).
        rate: (4, 4), the derivative of T_fixed_body.
    """

    number: int
    mesh: trimesh.Trimesh
    T_fixed_body: Transform
    rate: Transform

    def placed(self) -> trimesh.Trimesh:
        """The mesh in the fixed frame."""
        return self.mesh.copy().apply_transform(self.T_fixed_body)

    def velocity(self, points: NDArray[np.float64]) -> NDArray[np.float64]:
        """Velocity (N, 3) m/s of points (N, 3) of the body, in the fixed frame."""
        R, t = self.T_fixed_body[:3, :3], self.T_fixed_body[:3, 3]
        in_body = (points - t) @ R
        return in_body @ self.rate[:3, :3].T + self.rate[:3, 3]


class Scene:
    """Everything the sensors can see.

    Args:
        scenario: what moves.
        speed: m/s of the mannequin.
        robot: the sensorised robot; the second one is of the same kind.
        offset: (3,) metres by which the mannequin starts elsewhere.
    """

    def __init__(
        self, scenario: Scenario, speed: float, robot: Robot, offset: NDArray[np.float64]
    ) -> None:
        self._glide = scenario.mannequin_glide(speed)
        self._mannequin = mannequin()
        self._start = _MANNEQUIN_PLACE + np.array([*scenario.start, 0.0]) + offset
        self._robot = robot
        self.own = Arm(robot, np.eye(4), _posture(scenario.posture), scenario.robot_glide())
        self._second = _second_arm(robot, self._start, self._glide)
        self.static = surroundings()

    @property
    def duration(self) -> float:
        """Seconds until all have rested again."""
        return max(self._glide.end, self.own.end) + REST

    def target_velocity(self, time: float) -> NDArray[np.float64]:
        """Velocity (3,) m/s of the mannequin."""
        return self._glide.velocity(time)

    def T_base_target(self, time: float) -> Transform:  # noqa: N802 (a transformation)
        """Pose (4, 4) of the mannequin's frame."""
        pose = np.eye(4)
        pose[:3, 3] = self._start + self._glide.displacement(self._glide.travelled(time))
        return pose

    def bodies(self, time: float) -> list[Body]:
        """The mannequin and the links of both robots."""
        rate = np.zeros((4, 4))
        rate[:3, 3] = self.target_velocity(time)
        bodies = [Body(MANNEQUIN, self._mannequin, self.T_base_target(time), rate)]
        meshes = self._robot.collision_meshes
        poses, rates = self.own.link_poses(time), self.own.link_rates(time)
        bodies += [Body(OWN_ROBOT, m, poses[link], rates[link]) for link, m in meshes.items()]
        poses, rates = self._second.link_poses(time), self._second.link_rates(time)
        for number, (link, mesh) in enumerate(meshes.items(), SECOND_ROBOT):
            bodies.append(Body(number, mesh, poses[link], rates[link]))
        return bodies


def _posture(values: tuple[float, ...]) -> dict[str, float]:
    return dict(zip(_JOINTS, values, strict=True))


def _second_arm(robot: Robot, mannequin_start: NDArray[np.float64], glide: Glide) -> Arm:
    """The robot that holds the mannequin by the plate on its back."""
    T_fixed_base = trimesh.transformations.rotation_matrix(-np.pi / 2, (0.0, 0.0, 1.0))
    T_fixed_base[:3, 3] = _SECOND_ROBOT_PLACE
    posture = _posture(_SECOND_POSTURE)
    T_base_flange = robot.link_poses(posture)[FLANGE]
    grip = T_fixed_base[:3, :3].T @ (mannequin_start + GRIP - _SECOND_ROBOT_PLACE)
    T_base_flange[:3, 3] = grip - _FINGERS * T_base_flange[:3, 2]
    return Arm(robot, T_fixed_base, inverse_kinematics(robot, posture, T_base_flange), glide)
