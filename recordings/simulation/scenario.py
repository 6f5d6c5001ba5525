"""Scenarios of the simulator: the paper's three (section III-B), and more."""

from dataclasses import dataclass

import numpy as np

from recordings.simulation.actors import ActorFactory, crossing, fast, turning, walking
from recordings.simulation.trajectory import Trajectory

SPEEDS = (0.15, 0.20, 0.25, 0.30)
"""m/s, the paper's target speeds of the mannequin."""
TRIALS = (1, 2, 3, 4, 5)
"""The paper repeats every experiment five times."""

_Path = tuple[tuple[float, float, float], ...]

# Facing +y and upright, so that no ring looks at the ceiling or the bench.
_UPRIGHT = (np.pi / 2, -0.2, 0.0, -0.7, 0.0, np.pi + 0.5, np.pi / 4)


@dataclass(frozen=True)
class Scenario:
    """Scenario of an experiment.

    Attributes:
        name: as on the command line and in file names.
        text: description in one clause.
        start: (x, y) metres from the mannequin's nominal position to its start.
        mannequin: segments of the mannequin's path, metres in the fixed frame; empty where it
            rests.
        robot: segments of the sensorised end-effector's path, likewise.
        robot_speed: m/s of the sensorised end-effector.
        posture: the seven joints of the sensorised arm at the start, rad.
        speeds: default speeds, m/s.
        actors: makes the moving bodies, instead of the mannequin and the robot that carries it.
    """

    name: str
    text: str
    start: tuple[float, float] = (0.0, 0.0)
    mannequin: _Path = ()
    robot: _Path = ()
    robot_speed: float = 0.25
    posture: tuple[float, ...] = _UPRIGHT
    speeds: tuple[float, ...] = SPEEDS
    actors: ActorFactory | None = None

    @property
    def still(self) -> bool:
        """Whether nothing moves but the sensorised robot; then its speed is 0."""
        return self.actors is None and not self.mannequin

    def mannequin_trajectory(self, speed: float, ramp: float = 0.0) -> Trajectory | None:
        """Trajectory of the mannequin at `speed` m/s with ramps of `ramp` seconds, None at rest."""
        return Trajectory(np.array(self.mannequin), speed, ramp) if self.mannequin else None

    def robot_trajectory(self, ramp: float = 0.0) -> Trajectory | None:
        """Trajectory of the sensorised end-effector, None where it rests."""
        return Trajectory(np.array(self.robot), self.robot_speed, ramp) if self.robot else None


_TOWARDS: _Path = ((0.0, -0.30, 0.0),)
# The second segment continues for 0.10 m in the direction of the first.
_FIRST = np.array([0.05, -0.15, 0.0])
_SECOND = 0.10 * _FIRST / np.linalg.norm(_FIRST)
_RETREAT: _Path = (tuple(_FIRST.tolist()), tuple(_SECOND.tolist()))

SCENARIOS = {
    scenario.name: scenario
    for scenario in (
        Scenario(
            "towards",
            "the mannequin comes 0.30 m towards the robot, along -y",
            start=(0.0, 0.0),
            mannequin=_TOWARDS,
        ),
        Scenario(
            "sideways",
            "the mannequin passes 0.25 m sideways, along x",
            # Centred in front of the robot, at the distance of the first scenario's half-way point.
            start=(-0.125, -0.15),
            mannequin=((0.25, 0.0, 0.0),),
        ),
        Scenario(
            "robot_moving",
            "the mannequin comes as in towards while the sensorised arm draws back",
            start=(0.0, 0.0),
            mannequin=_TOWARDS,
            robot=_RETREAT,
        ),
        Scenario(
            "walking",
            "a person walks 1.04 m up to the robot, arms and legs swinging",
            speeds=(0.25, 0.5, 1.0),
            actors=walking,
        ),
        Scenario(
            "turning",
            "a mannequin turns by 90 degrees on the spot, its hand at the speed",
            actors=turning,
        ),
        Scenario(
            "crossing",
            "two mannequins pass each other along x, 1.20 m each",
            speeds=(0.25, 0.5),
            actors=crossing,
        ),
        Scenario(
            "fast",
            "a parcel flies past, 2.20 m along x",
            speeds=(0.5, 1.0, 1.5, 2.0),
            actors=fast,
        ),
        Scenario("still", "nothing moves; the mannequin stands there", speeds=(0.0,)),
        Scenario(
            "still_robot_moving",
            "nothing moves but the sensorised arm, as in robot_moving",
            robot=_RETREAT,
            speeds=(0.0,),
        ),
    )
}
"""{name: scenario}."""

PAPER_SCENARIOS = ("towards", "sideways", "robot_moving")
"""Names of the scenarios of the paper."""
