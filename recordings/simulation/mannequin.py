"""Meshes of a mannequin and a person, each part lofted over cross-sections."""

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    import trimesh

# Cross-sections from the lower to the upper end: height, half width, half depth, and offset of the
# centre to the front (-y), in metres. The origin is the centre of the chest; the body faces -y.
_TORSO = (
    (-0.420, 0.030, 0.020, 0.000),
    (-0.415, 0.120, 0.075, 0.000),
    (-0.390, 0.160, 0.105, 0.000),
    (-0.300, 0.172, 0.115, 0.000),
    (-0.160, 0.140, 0.095, 0.005),
    (-0.060, 0.150, 0.105, 0.012),
    (0.050, 0.172, 0.118, 0.018),
    (0.150, 0.190, 0.105, 0.008),
    (0.205, 0.178, 0.082, 0.000),
    (0.240, 0.110, 0.065, -0.005),
    (0.262, 0.062, 0.056, -0.005),
    (0.330, 0.054, 0.054, 0.005),
    (0.350, 0.020, 0.020, 0.005),
)
_HEAD = (
    (0.310, 0.008, 0.010, 0.040),
    (0.316, 0.032, 0.040, 0.036),
    (0.345, 0.056, 0.074, 0.022),
    (0.400, 0.071, 0.090, 0.010),
    (0.450, 0.077, 0.098, 0.002),
    (0.500, 0.073, 0.092, -0.002),
    (0.530, 0.055, 0.070, -0.004),
    (0.548, 0.025, 0.032, -0.004),
    (0.552, 0.006, 0.008, -0.004),
)
# Hanging arm from the finger tips to the shoulder, whose centre is at height 0.
_ARM = (
    (-0.640, 0.006, 0.010, 0.010),
    (-0.630, 0.014, 0.030, 0.010),
    (-0.560, 0.020, 0.042, 0.010),
    (-0.480, 0.026, 0.030, 0.008),
    (-0.400, 0.034, 0.036, 0.004),
    (-0.290, 0.038, 0.040, 0.000),
    (-0.150, 0.048, 0.050, 0.000),
    (-0.030, 0.056, 0.060, 0.000),
    (0.025, 0.046, 0.050, 0.000),
    (0.048, 0.012, 0.014, 0.000),
)
# Leg from the sole to the hip, whose centre is at height 0.
_LEG = (
    (-0.840, 0.036, 0.110, 0.060),
    (-0.830, 0.044, 0.120, 0.060),
    (-0.800, 0.044, 0.110, 0.052),
    (-0.760, 0.042, 0.066, 0.016),
    (-0.700, 0.040, 0.046, 0.000),
    (-0.550, 0.056, 0.062, -0.012),
    (-0.420, 0.058, 0.060, 0.000),
    (-0.250, 0.074, 0.078, 0.000),
    (-0.080, 0.088, 0.096, 0.000),
    (0.000, 0.086, 0.094, 0.000),
    (0.050, 0.020, 0.024, 0.000),
)
SHOULDER = (0.212, 0.0, 0.165)
"""The left shoulder, metres in the frame of the chest."""
HIP = (0.092, 0.0, -0.36)
"""The left hip, likewise."""
_SPREAD, _HANGING = 0.5, 0.12  # rad, of the arms away from the body
GRIP = (0.0, 0.125, 0.13)
"""Centre of the outer face of the plate between the shoulders, metres in the mannequin's frame."""
_PLATE = (0.10, 0.06, 0.10)

_RINGS, _SEGMENTS = 48, 40


def mannequin() -> "trimesh.Trimesh":
    """Upper half of a mannequin, about 0.97 m high, as closed parts that overlap.

    The origin is the centre of the chest, z points up, and the mannequin faces -y.
    """
    import trimesh

    left = _left_arm(_SPREAD)
    right = left.copy()
    right.apply_transform(trimesh.transformations.reflection_matrix((0, 0, 0), (1, 0, 0)))
    plate = trimesh.creation.box(_PLATE)
    plate.apply_translation((GRIP[0], GRIP[1] - _PLATE[1] / 2, GRIP[2]))
    return trimesh.util.concatenate([_loft(_TORSO), _loft(_HEAD), left, right, plate])  # type: ignore[return-value]


def person() -> "tuple[trimesh.Trimesh, trimesh.Trimesh, trimesh.Trimesh]":
    """Person of about 1.75 m: head and torso, left arm, left leg, in the frame of the chest.

    The limbs hang straight. The soles are 1.20 m below the centre of the chest.
    """
    import trimesh

    body = trimesh.util.concatenate([_loft(_TORSO), _loft(_HEAD)])
    leg = _loft(_LEG)
    leg.apply_translation(HIP)
    return body, _left_arm(_HANGING), leg  # type: ignore[return-value]


def _left_arm(spread: float) -> "trimesh.Trimesh":
    """Left arm at its shoulder, `spread` rad away from the body."""
    import trimesh

    arm = _loft(_ARM)
    arm.apply_transform(trimesh.transformations.rotation_matrix(-spread, (0.0, 1.0, 0.0)))
    return arm.apply_translation(SHOULDER)


def _loft(sections: tuple[tuple[float, float, float, float], ...]) -> "trimesh.Trimesh":
    """Closed surface with elliptic cross-sections, interpolated smoothly between those given."""
    import trimesh
    from scipy.interpolate import PchipInterpolator

    table = np.array(sections)
    # Denser at the ends, which are round.
    along = 0.5 - 0.5 * np.cos(np.pi * np.linspace(0.0, 1.0, _RINGS))
    heights = table[0, 0] + along * (table[-1, 0] - table[0, 0])
    width, depth, front = PchipInterpolator(table[:, 0], table[:, 1:])(heights).T
    angle = 2 * np.pi * np.arange(_SEGMENTS) / _SEGMENTS
    rings = np.empty((_RINGS, _SEGMENTS, 3))
    rings[..., 0] = width[:, None] * np.cos(angle)
    rings[..., 1] = depth[:, None] * np.sin(angle) - front[:, None]
    rings[..., 2] = heights[:, None]
    ends = np.stack([rings[0].mean(axis=0), rings[-1].mean(axis=0)])
    return trimesh.Trimesh(np.concatenate([rings.reshape(-1, 3), ends]), _faces())


def _faces() -> NDArray[np.int64]:
    """Triangles between neighbouring rings, and fans that close the two ends."""
    ring = np.arange(_SEGMENTS)
    after = np.roll(ring, -1)
    faces: list[NDArray[np.int64]] = []
    for lower in range(0, (_RINGS - 1) * _SEGMENTS, _SEGMENTS):
        upper = lower + _SEGMENTS
        faces.append(np.stack([lower + ring, lower + after, upper + ring], axis=1))
        faces.append(np.stack([lower + after, upper + after, upper + ring], axis=1))
    bottom, top = _RINGS * _SEGMENTS, _RINGS * _SEGMENTS + 1
    last = (_RINGS - 1) * _SEGMENTS
    faces.append(np.stack([after, ring, np.full_like(ring, bottom)], axis=1))
    faces.append(np.stack([last + ring, last + after, np.full_like(ring, top)], axis=1))
    return np.concatenate(faces)
