"""Objects of a scene: meshes with a surface, at rest or moving."""

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from recordings.simulation.motion import Motion
from recordings.simulation.surface import Surface
from robot_assets import Transform

if TYPE_CHECKING:
    import trimesh

SURROUNDINGS, TARGET, OWN_ROBOT, SECOND_ROBOT, FURTHER = 0, 1, 2, 3, 32
"""Numbers of objects in the truth.

The links of the second robot are numbered from SECOND_ROBOT on; further moving objects, such as
limbs, from FURTHER on.
"""


@dataclass(frozen=True)
class Piece:
    """Mesh at rest.

    Attributes:
        mesh: in the fixed frame, metres.
        surface: of the mesh.
    """

    mesh: "trimesh.Trimesh"
    surface: Surface


@dataclass(frozen=True)
class Body:
    """Rigid body at an instant: a mesh, its pose, and the derivative of the pose.

    Attributes:
        number: of its object in the truth.
        mesh: in its own frame, metres.
        surface: of the mesh.
        T_fixed_body: (4, 4).
        rate: (4, 4), the derivative of T_fixed_body.
    """

    number: int
    mesh: "trimesh.Trimesh"
    surface: Surface
    T_fixed_body: Transform
    rate: Transform

    @property
    def turn_rate(self) -> NDArray[np.float64]:
        """Angular velocity (3,) in rad/s, in the axes of the fixed frame."""
        spin = self.rate[:3, :3] @ self.T_fixed_body[:3, :3].T
        return np.array([spin[2, 1], spin[0, 2], spin[1, 0]])

    def posed_mesh(self) -> "trimesh.Trimesh":
        """The mesh in the fixed frame."""
        return self.mesh.copy().apply_transform(self.T_fixed_body)

    def velocity(self, points: NDArray[np.float64]) -> NDArray[np.float64]:
        """Velocity (N, 3) m/s of points (N, 3) of the body, in the fixed frame."""
        R, t = self.T_fixed_body[:3, :3], self.T_fixed_body[:3, 3]
        in_body = (points - t) @ R
        return in_body @ self.rate[:3, :3].T + self.rate[:3, 3]


@dataclass(frozen=True)
class Actor:
    """Rigid body with its motion over the whole recording.

    Attributes:
        number: of its object in the truth.
        mesh: in its own frame, metres.
        surface: of the mesh.
        motion: of its frame in the fixed frame.
    """

    number: int
    mesh: "trimesh.Trimesh"
    surface: Surface
    motion: Motion

    def at(self, time: float) -> Body:
        """The body at `time`, seconds from the start of the recording."""
        pose, rate = self.motion.pose(time), self.motion.rate(time)
        return Body(self.number, self.mesh, self.surface, pose, rate)
