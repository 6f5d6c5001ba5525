"""Rigid motions: where something is at a time, and how that changes."""

from dataclasses import dataclass
from typing import Protocol

import numpy as np
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

from recordings.simulation.glide import Glide
from robot_assets import Transform


class Motion(Protocol):
    """The pose of a body over time, in seconds from the start of the recording."""

    @property
    def end(self) -> float:
        """Seconds at which it is over."""
        ...

    def pose(self, time: float) -> Transform:
        """T_fixed_body (4, 4)."""
        ...

    def rate(self, time: float) -> Transform:
        """The derivative (4, 4) of T_fixed_body, in 1/s and m/s."""
        ...


@dataclass(frozen=True)
class Translation:
    """A body that glides without turning, or rests.

    Attributes:
        start: (3,) metres, where its origin is first.
        glide: along which it goes, None where it rests.
    """

    start: NDArray[np.float64]
    glide: Glide | None

    @property
    def end(self) -> float:
        """Seconds at which it is over."""
        return self.glide.end if self.glide else 0.0

    def pose(self, time: float) -> Transform:
        """T_fixed_body (4, 4)."""
        pose = np.eye(4)
        pose[:3, 3] = self.start
        if self.glide:
            pose[:3, 3] += self.glide.displacement(self.glide.travelled(time))
        return pose

    def rate(self, time: float) -> Transform:
        """The derivative (4, 4) of T_fixed_body, in 1/s and m/s."""
        rate = np.zeros((4, 4))
        if self.glide:
            rate[:3, 3] = self.glide.velocity(time)
        return rate


@dataclass(frozen=True)
class Turn:
    """A body that turns on the spot about a vertical axis.

    Attributes:
        place: (3,) metres, a point of the axis.
        arm: (3,) metres from there to the body's origin, in the body's axes.
        start: rad, its angle first.
        glide: whose length is that of the arc that the origin describes; its direction is nothing.
    """

    place: NDArray[np.float64]
    arm: NDArray[np.float64]
    start: float
    glide: Glide

    @property
    def end(self) -> float:
        """Seconds at which it is over."""
        return self.glide.end

    def pose(self, time: float) -> Transform:
        """T_fixed_body (4, 4)."""
        angle = self.start + self.glide.travelled(time) / self._radius
        pose = np.eye(4)
        pose[:3, :3] = Rotation.from_euler("z", angle).as_matrix()
        pose[:3, 3] = self.place + pose[:3, :3] @ self.arm
        return pose

    def rate(self, time: float) -> Transform:
        """The derivative (4, 4) of T_fixed_body, in 1/s and m/s."""
        turning = np.zeros((3, 3))
        turning[1, 0] = self.glide.speed_at(time) / self._radius
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
    """A limb that swings to and fro about the x axis through its joint while its owner glides.

    Attributes:
        owner: what the joint is fixed to.
        joint: (3,) metres in the owner's frame, which is the limb's at rest.
        amplitude: rad; a negative one begins backwards.
        step: metres of the owner's path between two moments at which the limb hangs straight.
    """

    owner: Translation
    joint: NDArray[np.float64]
    amplitude: float
    step: float

    @property
    def end(self) -> float:
        """Seconds at which it is over."""
        return self.owner.end

    def pose(self, time: float) -> Transform:
        """T_fixed_body (4, 4)."""
        return self.owner.pose(time) @ self._turned(self._angle(time))

    def rate(self, time: float) -> Transform:
        """The derivative (4, 4) of T_fixed_body, in 1/s and m/s."""
        angle = self._angle(time)
        turning = np.zeros((4, 4))
        # The derivative of a rotation about x is the rotation a quarter turn further, without x.
        turning[1:3, 1:3] = self._turned(angle + np.pi / 2)[1:3, 1:3]
        turning[:3, 3] = -turning[:3, :3] @ self.joint
        turned = self.owner.rate(time) @ self._turned(angle)
        return turned + self._angle_rate(time) * (self.owner.pose(time) @ turning)

    def _turned(self, angle: float) -> Transform:
        pose = np.eye(4)
        pose[:3, :3] = Rotation.from_euler("x", angle).as_matrix()
        pose[:3, 3] = self.joint - pose[:3, :3] @ self.joint
        return pose

    def _angle(self, time: float) -> float:
        return self.amplitude * float(np.sin(np.pi * self._travelled(time) / self.step))

    def _angle_rate(self, time: float) -> float:
        glide = self.owner.glide
        if glide is None:
            return 0.0
        phase = np.pi * self._travelled(time) / self.step
        return self.amplitude * float(np.cos(phase)) * np.pi / self.step * glide.speed_at(time)

    def _travelled(self, time: float) -> float:
        return self.owner.glide.travelled(time) if self.owner.glide else 0.0
