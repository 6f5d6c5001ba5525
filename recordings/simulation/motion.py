"""Rigid motions: pose over time, and its derivative."""

from dataclasses import dataclass
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from recordings.simulation.trajectory import Trajectory
from robot_assets import Transform


class Motion(Protocol):
    """Pose of a body over time, in seconds from the start of the recording."""

    @property
    def end(self) -> float:
        """Seconds at which it ends."""
        ...

    def pose(self, time: float) -> Transform:
        """T_fixed_body (4, 4)."""
        ...

    def rate(self, time: float) -> Transform:
        """The derivative (4, 4) of T_fixed_body, in 1/s and m/s."""
        ...


@dataclass(frozen=True)
class Translation:
    """Translation without rotation, or rest.

    Attributes:
        start: (3,) metres, first position of the origin.
        trajectory: of the origin, None where it rests.
    """

    start: NDArray[np.float64]
    trajectory: Trajectory | None

    @property
    def end(self) -> float:
        """Seconds at which it ends."""
        return self.trajectory.end if self.trajectory else 0.0

    def pose(self, time: float) -> Transform:
        """T_fixed_body (4, 4)."""
        pose = np.eye(4)
        pose[:3, 3] = self.start
        if self.trajectory:
            pose[:3, 3] += self.trajectory.displacement(self.trajectory.travelled(time))
        return pose

    def rate(self, time: float) -> Transform:
        """The derivative (4, 4) of T_fixed_body, in 1/s and m/s."""
        rate = np.zeros((4, 4))
        if self.trajectory:
            rate[:3, 3] = self.trajectory.velocity(time)
        return rate


@dataclass(frozen=True)
class Turn:
    """Rotation about a fixed vertical axis.

    Attributes:
        centre: (3,) metres, a point of the axis.
        arm: (3,) metres from the centre to the body's origin, in the body's axes.
        start: first angle, rad.
        trajectory: of the origin along its arc; only its length counts, not its direction.
    """

    centre: NDArray[np.float64]
    arm: NDArray[np.float64]
    start: float
    trajectory: Trajectory

    @property
    def end(self) -> float:
        """Seconds at which it ends."""
        return self.trajectory.end

    def pose(self, time: float) -> Transform:
        """T_fixed_body (4, 4)."""
        from scipy.spatial.transform import Rotation

        angle = self.start + self.trajectory.travelled(time) / self._radius
        pose = np.eye(4)
        pose[:3, :3] = Rotation.from_euler("z", angle).as_matrix()
        pose[:3, 3] = self.centre + pose[:3, :3] @ self.arm
        return pose

    def rate(self, time: float) -> Transform:
        """The derivative (4, 4) of T_fixed_body, in 1/s and m/s."""
        turning = np.zeros((3, 3))
        turning[1, 0] = self.trajectory.speed_at(time) / self._radius
        turning[0, 1] = -turning[1, 0]
        rate = np.zeros((4, 4))
        rate[:3, :3] = turning @ self.pose(time)[:3, :3]
        rate[:3, 3] = rate[:3, :3] @ self.arm
        return rate

    @property
    def _radius(self) -> float:
        return float(np.hypot(*self.arm[:2]))


@dataclass(frozen=True)
class Swing:
    """Swing of a limb about the x axis through its joint, while the body it hangs on translates.

    Attributes:
        parent: motion of that body.
        joint: (3,) metres in the parent's frame, which is the limb's at rest.
        amplitude: rad; a negative one begins backwards.
        step: metres of the parent's path for half a period.
    """

    parent: Translation
    joint: NDArray[np.float64]
    amplitude: float
    step: float

    @property
    def end(self) -> float:
        """Seconds at which it ends."""
        return self.parent.end

    def pose(self, time: float) -> Transform:
        """T_fixed_body (4, 4)."""
        return self.parent.pose(time) @ self._turned(self._angle(time))

    def rate(self, time: float) -> Transform:
        """The derivative (4, 4) of T_fixed_body, in 1/s and m/s."""
        angle = self._angle(time)
        turning = np.zeros((4, 4))
        # The derivative of a rotation about x is the rotation 90 degrees further, without x.
        turning[1:3, 1:3] = self._turned(angle + np.pi / 2)[1:3, 1:3]
        turning[:3, 3] = -turning[:3, :3] @ self.joint
        turned = self.parent.rate(time) @ self._turned(angle)
        return turned + self._angle_rate(time) * (self.parent.pose(time) @ turning)

    def _turned(self, angle: float) -> Transform:
        from scipy.spatial.transform import Rotation

        pose = np.eye(4)
        pose[:3, :3] = Rotation.from_euler("x", angle).as_matrix()
        pose[:3, 3] = self.joint - pose[:3, :3] @ self.joint
        return pose

    def _angle(self, time: float) -> float:
        return self.amplitude * float(np.sin(np.pi * self._travelled(time) / self.step))

    def _angle_rate(self, time: float) -> float:
        trajectory = self.parent.trajectory
        if trajectory is None:
            return 0.0
        phase = np.pi * self._travelled(time) / self.step
        return self.amplitude * float(np.cos(phase)) * np.pi / self.step * trajectory.speed_at(time)

    def _travelled(self, time: float) -> float:
        return self.parent.trajectory.travelled(time) if self.parent.trajectory else 0.0
