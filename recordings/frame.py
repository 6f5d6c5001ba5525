"""What a recording holds of one instant, before it is written."""

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray


@dataclass(frozen=True)
class PointTruth:
    """The truth of every valid reading of a frame, one row per reading.

    Attributes:
        points: (N, 3) metres in the fixed frame, where the zone's surface truly is.
        velocity: (N, 3) m/s in the fixed frame, zero where static.
        object: (N,) number of the object that the zone sees, 0 for static surroundings.
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
    """One reading of all sensors of a rig on a robot, with what is known of the truth.

    The fixed frame is the robot's base.

    Attributes:
        stamp: seconds.
        ranges: (S, rows, columns) metres as the sensors report them, NaN where they report none.
        joint_positions: {the robot's joint: rad or m}.
        T_base_target: (4, 4) pose of the moving object's frame.
        target_velocity: (3,) m/s of the moving object.
        truth: of every valid reading.
        target_turn_rate: (3,) rad/s of the moving object.
        object_poses: {number in the truth: T_base_object (4, 4)} of objects whose pose is known,
            the moving object among them.
        status: (S, rows, columns) ST's target status of each range; None where all count.
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
    """Where a written recording comes from; it goes into the file's metadata.

    Attributes:
        simulated: whether the readings were computed and not measured.
        scenario: name of the scenario, such as "towards".
        speed: m/s that was asked of the moving object.
        trial: number of the trial, from 1.
        seed: of the random numbers.
        noise: name and one-line description of the noise model.
        command: the command that makes the recording again.
        imperfections: names of what is wrong with the recording besides noise.
        rig: name of the rig that saw it, "" where an older file does not say; the rig itself is
            the file's attachment rig.toml.
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
