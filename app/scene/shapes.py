"""Meshes prepared for the browser: welded, split by colour, and cached."""

import hashlib
import threading
from dataclasses import dataclass
from functools import lru_cache
from itertools import product

import numpy as np
import trimesh
from numpy.typing import NDArray

from app.scene.kept_shapes import Part, keep_parts, kept_parts
from estimator.libraries import open3d
from robot_assets import Robot

_DARKEST = 84  # lowest channel value: darker meshes are invisible on a dark background
_GRAIN = 1 / 4096  # metres, a power of two: vertices on such a grid are sent in half of the bytes
_COARSE = 500  # faces: finer pieces are drawn with half of theirs
# Faces that meet at a larger angle than this keep a sharp edge; others are smooth-shaded.
_EDGE = np.radians(35.0)
_making = threading.Lock()
"""A shape takes a second: who asks for it meanwhile waits, instead of making it, too."""


@dataclass(frozen=True)
class RobotShape:
    """Visual meshes of a robot.

    Attributes:
        links: {link: its parts in the link's frame}.
        digest: of the meshes; equal for robots that look the same.
    """

    links: dict[str, tuple[Part, ...]]
    digest: str


def robot_shape(robot: Robot) -> RobotShape:
    """The visual meshes of a robot, welded and split by link and colour."""
    with _making:
        return _robot_shape(robot)


@lru_cache(maxsize=4)
def _robot_shape(robot: Robot) -> RobotShape:
    links = kept_parts(robot)
    if links is None:
        links = {link: _parts(mesh) for link, mesh in robot.visual_meshes.items()}
        keep_parts(robot, links)
    digest = hashlib.sha256()
    for link, parts in links.items():
        for part in parts:
            digest.update(f"{link} {part.colour}".encode())
            digest.update(part.vertices.tobytes() + part.faces.tobytes())
    return RobotShape(links, digest.hexdigest())


def ring_through(positions: NDArray[np.float64]) -> trimesh.Trimesh | None:
    """Torus through points (N, 3) on a circle, None for fewer than three.

    The circle may lie in any plane; the torus passes slightly inside the points.
    """
    if len(positions) < 3:
        return None
    centre = positions.mean(axis=0)
    _, _, axes = np.linalg.svd(positions - centre)
    radius = np.linalg.norm(positions - centre, axis=1).mean()
    pose = np.eye(4)
    pose[:3, :3] = np.array([axes[0], axes[1], np.cross(axes[0], axes[1])]).T
    pose[:3, 3] = centre
    torus = trimesh.creation.torus(
        major_radius=0.97 * radius, minor_radius=0.006, major_sections=48, minor_sections=12
    )
    torus.apply_transform(pose)
    return torus


def box_corners(low: NDArray[np.floating], high: NDArray[np.floating]) -> NDArray[np.float64]:
    """Corners (8, 3) of the box between two of them, (3,) each."""
    return np.array(list(product(*zip(low, high, strict=True))))


def corners_of(
    vertices: NDArray[np.floating], T_fixed_mesh: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Corners (8, 3), in the fixed frame, of the box around vertices (V, 3), V >= 1, in their own.

    NaN where the pose (4, 4) is.
    """
    box = box_corners(vertices.min(axis=0), vertices.max(axis=0))
    return box @ T_fixed_mesh[:3, :3].T + T_fixed_mesh[:3, 3]


def coarse(
    vertices: NDArray[np.float32], faces: NDArray[np.uint32], cell: float
) -> tuple[NDArray[np.float32], NDArray[np.uint32]]:
    """A surface with one vertex per cell: the mean of those in it.

    Args:
        vertices: (V, 3) metres.
        faces: (F, 3) indices into them.
        cell: edge of a cubic cell, metres.
    """
    cells = np.floor(vertices / cell).astype(np.int64)
    _, merged, count = np.unique(cells, axis=0, return_inverse=True, return_counts=True)
    merged = merged.reshape(-1)
    means = [np.bincount(merged, vertices[:, axis], len(count)) / count for axis in range(3)]
    corners = merged[faces.astype(np.int64)]
    a, b, c = corners.T
    kept = corners[(a != b) & (b != c) & (c != a)]
    # Of triangles on the same corners one is enough.
    _, first = np.unique(np.sort(kept, axis=1), axis=0, return_index=True)
    return np.stack(means, axis=1).astype(np.float32), kept[np.sort(first)].astype(np.uint32)


def _parts(mesh: trimesh.Trimesh) -> tuple[Part, ...]:
    vertex_colours = np.asarray(mesh.visual.vertex_colors)  # type: ignore[union-attr]
    colours, of_face = np.unique(vertex_colours[mesh.faces[:, 0], :3], axis=0, return_inverse=True)
    parts: list[Part] = []
    for index, colour in enumerate(colours):
        piece = trimesh.Trimesh(mesh.vertices, mesh.faces[of_face.reshape(-1) == index])
        red, green, blue = (max(int(channel), _DARKEST) for channel in colour)
        piece = trimesh.graph.smooth_shade(_coarsened(piece), angle=_EDGE)
        parts.append(
            Part(
                (_GRAIN * np.round(piece.vertices / _GRAIN)).astype(np.float32),
                np.asarray(piece.faces, dtype=np.uint32),
                (red, green, blue),
            )
        )
    return tuple(parts)


def _coarsened(piece: trimesh.Trimesh) -> trimesh.Trimesh:
    """A fine mesh with half of its faces, where they change its shape least.

    Robots' visual meshes are made for close-ups; a page would load them for seconds.
    """
    if len(piece.faces) <= _COARSE:
        return piece
    o3d = open3d()
    mesh = o3d.geometry.TriangleMesh(
        o3d.utility.Vector3dVector(piece.vertices), o3d.utility.Vector3iVector(piece.faces)
    )
    coarse = mesh.simplify_quadric_decimation(len(piece.faces) // 2)
    return trimesh.Trimesh(np.asarray(coarse.vertices), np.asarray(coarse.triangles))
