"""Scene of a scenario at any time: the robots, the moving bodies, and the lab."""

import numpy as np
from numpy.typing import NDArray

from recordings.object_meshes import ObjectMesh
from recordings.object_truth import OBJECT_FRAME, TARGET_FRAME
from recordings.simulation.arm import Arm
from recordings.simulation.body import OWN_ROBOT, SECOND_ROBOT, TARGET, Actor, Body
from recordings.simulation.inverse_kinematics import FLANGE, inverse_kinematics
from recordings.simulation.mannequin import GRIP, mannequin
from recordings.simulation.motion import Translation
from recordings.simulation.scenario import Scenario
from recordings.simulation.surface import PAINT, PLASTIC
from recordings.simulation.surroundings import surroundings
from recordings.simulation.trajectory import REST, Trajectory
from robot_assets import Robot, Transform

# Start of the centre of the mannequin's chest in the fixed frame. Its front is then 0.75 m from the
# robot's axis, our reading of the distance in the paper.
_MANNEQUIN_POSITION = np.array([0.0, 0.885, 0.43])
# Behind the mannequin, facing the first robot.
_SECOND_ROBOT_POSITION = np.array([0.0, 1.485, 0.0])
_SECOND_POSTURE = (0.0, -0.4, 0.0, -2.3, 0.0, 2.75, np.pi / 4)
_FINGERS = 0.105  # metres from the flange to the held plate
_SHORTEST = 3.0  # seconds
_JOINTS = tuple(f"panda_joint{i}" for i in range(1, 8))


class Scene:
    """All objects that the sensors can see.

    Args:
        scenario: to play.
        speed: m/s of the target.
        robot: the sensorised robot; the second robot is a copy.
        offset: (3,) metres, added to the target's start.
        ramp: seconds that motions take to reach their speed, and to stop.
    """

    def __init__(
        self,
        scenario: Scenario,
        speed: float,
        robot: Robot,
        offset: NDArray[np.float64],
        ramp: float = 0.0,
    ) -> None:
        self._robot = robot
        self.own = Arm(
            robot, np.eye(4), _posture(scenario.posture), scenario.robot_trajectory(ramp)
        )
        self._second: Arm | None = None
        if scenario.actors:
            self._actors = scenario.actors(speed, offset, ramp)
        else:
            start = _MANNEQUIN_POSITION + np.array([*scenario.start, 0.0]) + offset
            trajectory = scenario.mannequin_trajectory(speed, ramp)
            self._actors = [Actor(TARGET, mannequin(), PLASTIC, Translation(start, trajectory))]
            self._second = _second_arm(robot, start, trajectory)
        self.static = surroundings(pedestal=self._second is not None)
        # The constant velocity of a mannequin defines its motion; no poses are needed.
        self._velocity_suffices = scenario.actors is None and ramp == 0.0

    @property
    def duration(self) -> float:
        """Seconds until the end of the final rest."""
        ends = [actor.motion.end for actor in self._actors]
        end = max(self.own.end, *ends) + REST
        return end if any(ends) else max(end, _SHORTEST)

    def target(self, time: float) -> Body:
        """The target at `time`."""
        return self._actors[0].at(time)

    def object_poses(self, time: float) -> dict[int, Transform]:
        """{number: T_fixed_body (4, 4)} of the actors; empty where a constant velocity suffices."""
        if self._velocity_suffices:
            return {}
        return {actor.number: actor.motion.pose(time) for actor in self._actors}

    @property
    def meshes(self) -> dict[str, ObjectMesh]:
        """{frame in /tf: surface} of the actors."""
        frames = [TARGET_FRAME, *(f"{OBJECT_FRAME}{actor.number}" for actor in self._actors[1:])]
        return {
            frame: ObjectMesh(
                np.asarray(actor.mesh.vertices, np.float32), np.asarray(actor.mesh.faces, np.uint32)
            )
            for frame, actor in zip(frames, self._actors, strict=True)
        }

    def bodies(self, time: float) -> list[Body]:
        """The actors and the links of the robots."""
        bodies = [actor.at(time) for actor in self._actors]
        meshes = self._robot.collision_meshes
        poses, rates = self.own.link_poses(time), self.own.link_rates(time)
        for link, mesh in meshes.items():
            bodies.append(Body(OWN_ROBOT, mesh, PAINT, poses[link], rates[link]))
        if self._second:
            poses, rates = self._second.link_poses(time), self._second.link_rates(time)
            for number, (link, mesh) in enumerate(meshes.items(), SECOND_ROBOT):
                bodies.append(Body(number, mesh, PAINT, poses[link], rates[link]))
        return bodies


def _posture(values: tuple[float, ...]) -> dict[str, float]:
    return dict(zip(_JOINTS, values, strict=True))


def _second_arm(
    robot: Robot, mannequin_start: NDArray[np.float64], trajectory: Trajectory | None
) -> Arm:
    """Robot that holds the mannequin by the plate on its back."""
    import trimesh

    T_fixed_base = trimesh.transformations.rotation_matrix(-np.pi / 2, (0.0, 0.0, 1.0))
    T_fixed_base[:3, 3] = _SECOND_ROBOT_POSITION
    posture = _posture(_SECOND_POSTURE)
    T_base_flange = robot.link_poses(posture)[FLANGE]
    grip = T_fixed_base[:3, :3].T @ (mannequin_start + GRIP - _SECOND_ROBOT_POSITION)
    T_base_flange[:3, 3] = grip - _FINGERS * T_base_flange[:3, 2]
    return Arm(robot, T_fixed_base, inverse_kinematics(robot, posture, T_base_flange), trajectory)
