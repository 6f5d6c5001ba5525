"""Robot and sensors of a pair as one solid, which hides what is behind it."""

from dataclasses import dataclass

import numpy as np
import trimesh
from numpy.typing import NDArray

from app.analysis.pairs import Pair
from app.scene.colours import SENSOR, Colour
from app.scene.sensors_view import BODY
from app.scene.shapes import ring_through, robot_shape
from recordings import RecordedSensor, Recording


@dataclass(frozen=True)
class Solid:
    """Triangles with their colours.

    Attributes:
        mesh: in the drawing's frame, metres.
        colours: (F, 3) of each triangle.
        outlined: (F,) whether a triangle is of the robot, and its outline is drawn.
    """

    mesh: trimesh.Trimesh
    colours: NDArray[np.uint8]
    outlined: NDArray[np.bool_]


def solid_of(
    recording: Recording,
    pair: Pair,
    R_drawing_fixed: NDArray[np.float64],
    layers: frozenset[str],
) -> Solid | None:
    """The solid of a pair's drawing, None where nothing of it is shown.

    Args:
        recording: of the pair.
        pair: whose poses count.
        R_drawing_fixed: (3, 3) from the fixed frame into the drawing's.
        layers: that are visible.
    """
    robot = _robot(recording, pair) if "Robot" in layers else []
    sensors: list[tuple[trimesh.Trimesh, Colour]] = []
    if "Sensors" in layers:
        sensors = _sensors(recording.sensors, pair.target.T_fixed_sensor)
    pieces = [*robot, *sensors]
    if not pieces:
        return None
    turn = np.eye(4)
    turn[:3, :3] = R_drawing_fixed
    mesh = trimesh.util.concatenate([piece for piece, _ in pieces])
    assert isinstance(mesh, trimesh.Trimesh)
    mesh.apply_transform(turn)
    colours = [np.tile(np.array(c, np.uint8), (len(piece.faces), 1)) for piece, c in pieces]
    outlined = np.arange(len(mesh.faces)) < sum(len(piece.faces) for piece, _ in robot)
    return Solid(mesh, np.vstack(colours), outlined)


def true_object_of(
    recording: Recording,
    pair: Pair,
    R_drawing_fixed: NDArray[np.float64],
    layers: frozenset[str],
) -> Solid | None:
    """The surfaces of what moves, where it truly is; None where unknown or not shown."""
    pieces: list[trimesh.Trimesh] = []
    for frame, surface in recording.object_meshes.items() if "True object" in layers else ():
        pose = pair.object_poses.get(frame)
        if pose is not None and np.isfinite(pose).all():
            piece = trimesh.Trimesh(surface.vertices, surface.faces)
            piece.apply_transform(pose)
            pieces.append(piece)
    if not pieces:
        return None
    turn = np.eye(4)
    turn[:3, :3] = R_drawing_fixed
    mesh = trimesh.util.concatenate(pieces)
    assert isinstance(mesh, trimesh.Trimesh)
    mesh.apply_transform(turn)
    count = len(mesh.faces)
    return Solid(mesh, np.zeros((count, 3), np.uint8), np.ones(count, dtype=bool))


def _robot(recording: Recording, pair: Pair) -> list[tuple[trimesh.Trimesh, Colour]]:
    pieces: list[tuple[trimesh.Trimesh, Colour]] = []
    shape = robot_shape(recording.robot) if recording.robot else None
    for link, parts in shape.links.items() if shape else ():
        pose = pair.link_poses.get(link)
        if pose is None or not np.isfinite(pose).all():
            continue
        for part in parts:
            # Vertices on sharp edges are double, so that these are shaded so.
            piece = trimesh.Trimesh(part.vertices, part.faces, process=False)
            piece.merge_vertices(merge_norm=True, merge_tex=True)
            piece.apply_transform(pose)
            pieces.append((piece, part.colour))
    return pieces


def _sensors(
    sensors: tuple[RecordedSensor, ...], poses: NDArray[np.float64]
) -> list[tuple[trimesh.Trimesh, Colour]]:
    known = np.isfinite(poses).all(axis=(1, 2))
    pieces: list[tuple[trimesh.Trimesh, Colour]] = []
    for pose in poses[known]:
        body = trimesh.creation.box(BODY)
        body.apply_translation((0.0, 0.0, -BODY[2] / 2))
        body.apply_transform(pose)
        pieces.append((body, SENSOR))
    if known.all():
        for ring in {sensor.ring: None for sensor in sensors if sensor.ring}:
            members = [i for i, sensor in enumerate(sensors) if sensor.ring == ring]
            band = ring_through(poses[members, :3, 3])
            if band is not None:
                pieces.append((band, SENSOR))
    return pieces
