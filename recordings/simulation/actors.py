"""Actors of the scenarios beyond the paper's: moving bodies without a second robot.

An `ActorFactory` takes the speed in m/s, the trial's offset (3,) of the start in metres, and the
duration of the ramps in seconds; the first of its actors is the target.
"""

from collections.abc import Callable
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from recordings.simulation.body import FURTHER, TARGET, Actor
from recordings.simulation.mannequin import HIP, SHOULDER, mannequin, person
from recordings.simulation.motion import Swing, Translation, Turn
from recordings.simulation.surface import CARDBOARD, CLOTH, PLASTIC
from recordings.simulation.trajectory import Trajectory

if TYPE_CHECKING:
    import trimesh

ActorFactory = Callable[[float, NDArray[np.float64], float], list[Actor]]

_FLOOR = -0.75  # height below the robots' bases, metres
_CHEST = 0.45  # height of a standing person's chest
_STEP = 0.52  # metres
_LEG_SWING, _ARM_SWING = 0.31, 0.25  # rad; the legs' fits the length of a step
_HAND = (0.50, 0.0, -0.36)  # of the mannequin, in its frame


def walking(speed: float, offset: NDArray[np.float64], ramp: float) -> list[Actor]:
    """A person walks up to the robot: two steps of 0.52 m, with arms and legs swinging."""
    import trimesh

    trajectory = Trajectory(np.array([[0.0, -2 * _STEP, 0.0]]), speed, ramp)
    # High enough that the toes of the rear leg, which point down, stay above the floor.
    walk = Translation(np.array([0.0, 1.70, _CHEST + 0.035]) + offset, trajectory)
    torso, left_arm, left_leg = person()
    mirrored = trimesh.transformations.reflection_matrix((0, 0, 0), (1, 0, 0))
    actors = [Actor(TARGET, torso, CLOTH, walk)]
    for mesh, joint, swing in ((left_arm, SHOULDER, _ARM_SWING), (left_leg, HIP, -_LEG_SWING)):
        right = mesh.copy().apply_transform(mirrored)
        for side, limb in ((1, mesh), (-1, right)):
            at = np.array(joint) * (side, 1, 1)
            motion = Swing(walk, at, side * swing, _STEP)
            actors.append(Actor(FURTHER + len(actors) - 1, limb, CLOTH, motion))
    return actors


def turning(speed: float, offset: NDArray[np.float64], ramp: float) -> list[Actor]:
    """A mannequin on a post turns by 90 degrees; its hand is the target and has the speed."""
    hand = np.array(_HAND)
    arc = 0.5 * np.pi * float(np.hypot(*hand[:2]))
    centre = np.array([0.0, 0.75, _CHEST]) + offset
    motion = Turn(centre, hand, -0.25 * np.pi, Trajectory(np.array([[arc, 0.0, 0.0]]), speed, ramp))
    mesh = _on_a_post(centre[2]).apply_translation(-hand)
    return [Actor(TARGET, mesh, PLASTIC, motion)]


def crossing(speed: float, offset: NDArray[np.float64], ramp: float) -> list[Actor]:
    """Two mannequins on posts pass each other along x; the front one is the target."""
    path = np.array([[1.2, 0.0, 0.0]])
    front = Translation(np.array([-0.6, 0.70, _CHEST]) + offset, Trajectory(path, speed, ramp))
    behind = Translation(np.array([0.6, 1.20, _CHEST]) + offset, Trajectory(-path, speed, ramp))
    mesh = _on_a_post(_CHEST + offset[2])
    return [Actor(TARGET, mesh, PLASTIC, front), Actor(FURTHER, mesh, PLASTIC, behind)]


def fast(speed: float, offset: NDArray[np.float64], ramp: float) -> list[Actor]:
    """A parcel flies past along x."""
    import trimesh

    trajectory = Trajectory(np.array([[2.2, 0.0, 0.0]]), speed, ramp)
    motion = Translation(np.array([-1.1, 0.70, 0.40]) + offset, trajectory)
    return [Actor(TARGET, trimesh.creation.box((0.50, 0.30, 0.60)), CARDBOARD, motion)]


def _on_a_post(height: float) -> "trimesh.Trimesh":
    """Mannequin on a post, with its chest at `height` metres."""
    import trimesh

    length = height - 0.40 - _FLOOR
    post = trimesh.creation.cylinder(0.03, length)
    post.apply_translation((0.0, 0.0, _FLOOR - height + length / 2))
    return trimesh.util.concatenate([mannequin(), post])  # type: ignore[return-value]
