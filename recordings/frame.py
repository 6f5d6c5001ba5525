"""Frame of a recording to be written, with its truth, and the recording's provenance."""

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray


@dataclass(frozen=True)
class PointTruth:
    """Truth of every valid reading of a frame, one row per reading.

    Attributes:
        points: (N, 3) metres in the fixed frame, true position of the measured surface.
        velocity: (N, 3) m/s in the fixed frame, zero where static.
        object: (N,) number of the measured object, 0 for static surroundings.
        sensor: (N,) index of the sensor.
        zone: (N,) index of the zone, row * columns + column.
    """

    points: NDArray[np.float64]
    velocity: NDArray[np.float64]
    object: NDArray[np.int64]
    sensor: NDArray[np.int64]
    zone: NDArray[np.int64]


@dataclass(frozen=True)
class Frame:
    """One reading of all sensors of a rig on a robot, with the truth.

    The fixed frame is the robot's base.

    Attributes:
        stamp: seconds.
        ranges: (S, rows, columns) metres as reported by the sensors, NaN where there is none.
        joint_positions: {the robot's joint: rad or m}.
        T_base_target: (4, 4) pose of the moving object's frame.
        target_velocity: (3,) m/s of the moving object.
        truth: of every valid reading.
        target_turn_rate: (3,) rad/s of the moving object.
        object_poses: {number in the truth: T_base_object (4, 4)} of objects whose pose is known,
            the moving object among them.
        status: (S, rows, columns) ST's target status of each range; None where all are valid.
    """

    stamp: float
    ranges: NDArray[np.float64]
    joint_positions: dict[str, float]
    T_base_target: NDArray[np.float64]
    target_velocity: NDArray[np.float64]
    truth: PointTruth
    target_turn_rate: NDArray[np.float64] = field(default_factory=lambda: np.zeros(3))
    object_poses: dict[int, NDArray[np.float64]] = field(default_factory=dict)
    status: NDArray[np.uint8] | None = None


@dataclass(frozen=True)
class Provenance:
    """Provenance of a written recording, stored in the file's metadata.

    Attributes:
        simulated: whether the readings were simulated.
        scenario: name of the scenario, such as "towards".
        speed: commanded speed of the moving object, m/s.
        trial: number of the trial, from 1.
        seed: of the random numbers.
        noise: name and one-line description of the noise model.
        command: the command that reproduces the recording.
        imperfections: names of the simulated imperfections.
        rig: name of the rig, "" in older files; the rig itself is the file's attachment rig.toml.
        repeated: what was repeated to make it longer than its simulation, "" for nothing.
    """

    simulated: bool
    scenario: str
    speed: float
    trial: int
    seed: int
    noise: str
    command: str
    imperfections: tuple[str, ...] = ()
    rig: str = ""
    repeated: str = ""

    @property
    def experiment(self) -> str:
        """Text of scenario, speed and trial, such as "towards, 0.2 m/s, trial 1"."""
        return f"{self.scenario}, {self.speed:g} m/s, trial {self.trial}"
