"""A solid as a draughtsman draws it: its outline without hidden lines, and its shades."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from app.exports.pinhole import Pinhole
from app.exports.solid import Solid
from robot_assets import RayCaster

_SHARP = np.radians(40.0)
"""Angle between two faces from which their edge is drawn wherever it is seen."""

_STEP = 0.7  # of the picture's unit, the longest piece of an edge that is seen or hidden as a whole
_SKIN = 0.006  # metres below the surface that still count as seen
_PITCH = 0.25  # of the picture's unit, between the rays that find shades
_MOST_RAYS = 600_000
_SKY = np.array([0.25, -0.4, 0.88])  # towards the light, in the drawing's frame


@dataclass(frozen=True)
class Shades:
    """Grid of what a picture's rays hit.

    Attributes:
        x: (W,) in the picture's unit.
        y: (H,) in the picture's unit.
        colour: (H, W) index into `colours`, -1 where nothing is hit.
        light: (H, W) brightness, 0 to 1.
        colours: (C, 3).
    """

    x: NDArray[np.float64]
    y: NDArray[np.float64]
    colour: NDArray[np.int64]
    light: NDArray[np.float64]
    colours: NDArray[np.uint8]


class Sight:
    """What a camera sees of a solid, and of what is behind it.

    Args:
        pinhole: the camera and its picture.
        solid: in the drawing's frame, None for nothing in the way.
    """

    def __init__(self, pinhole: Pinhole, solid: Solid | None) -> None:
        self._pinhole, self._solid = pinhole, solid
        self._caster = RayCaster(solid.mesh) if solid else None
        self._eye = np.array(pinhole.camera.position)

    def sees(self, points: NDArray[np.float64]) -> NDArray[np.bool_]:
        """Mask (N,) of the points (N, 3) of the drawing that the solid does not hide."""
        if self._caster is None or len(points) == 0:
            return np.ones(len(points), dtype=bool)
        ways = points - self._eye
        distances = np.linalg.norm(ways, axis=1)
        directions = ways / np.maximum(distances, 1e-9)[:, None]
        reached, _ = self._caster.cast(np.tile(self._eye, (len(points), 1)), directions)
        return reached > distances - _SKIN

    def seen_parts(self, segments: NDArray[np.float64]) -> NDArray[np.float64]:
        """Seen parts (M, 2, 2), in the picture, of segments (N, 2, 3) of the drawing."""
        ends, depth = self._pinhole.project(segments)
        ends, segments = (some[(depth > 0).all(axis=1)] for some in (ends, segments))
        lengths = np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1)
        counts = np.clip(np.ceil(lengths / _STEP), 1, 400).astype(int)
        owner = np.repeat(np.arange(len(counts)), counts)
        number = np.arange(len(owner)) - np.repeat(np.cumsum(counts) - counts, counts)
        begin, end = number / counts[owner], (number + 1) / counts[owner]
        along = segments[owner, 1] - segments[owner, 0]
        seen = self.sees(segments[owner, 0] + ((begin + end) / 2)[:, None] * along)
        # Neighbouring pieces that are seen are one.
        first = seen & ~np.r_[False, seen[:-1] & (owner[1:] == owner[:-1])]
        last = seen & ~np.r_[seen[1:] & (owner[1:] == owner[:-1]), False]
        pieces = (
            segments[owner[first], 0, None]
            + np.stack([begin[first], end[last]], axis=1)[:, :, None] * along[first, None]
        )
        return self._pinhole.project(pieces)[0]

    def outline(self) -> NDArray[np.float64]:
        """Segments (M, 2, 2) of the solid's outline in the picture."""
        if self._solid is None:
            return np.zeros((0, 2, 2))
        mesh = self._solid.mesh
        corners, normals = np.asarray(mesh.vertices), np.asarray(mesh.face_normals)
        facing = np.einsum("ij,ij->i", normals, self._eye - np.asarray(mesh.triangles)[:, 0]) > 0
        faces, edges = np.asarray(mesh.face_adjacency), np.asarray(mesh.face_adjacency_edges)
        near = facing[faces]
        drawn = near[:, 0] != near[:, 1]
        drawn |= near.all(axis=1) & (np.asarray(mesh.face_adjacency_angles) > _SHARP)
        drawn &= self._solid.outlined[faces].all(axis=1)
        return self.seen_parts(corners[edges[drawn]])

    def shades(self) -> Shades | None:
        """Colours and brightness of the solid on a grid over the picture, None without one."""
        if self._solid is None or self._caster is None:
            return None
        pinhole, solid = self._pinhole, self._solid
        pitch = max(_PITCH, float(np.sqrt(pinhole.width * pinhole.height / _MOST_RAYS)))
        x, y = (np.arange(-pitch, end + pitch, pitch) for end in (pinhole.width, pinhole.height))
        across, down = np.meshgrid(x, y)
        scale = pinhole.height / 2 / np.tan(pinhole.camera.fov / 2)
        slopes = np.stack(
            [
                (across - pinhole.width / 2) / scale,
                (down - pinhole.height / 2) / scale,
                np.ones_like(across),
            ],
            axis=-1,
        ).reshape(-1, 3)
        ways = slopes @ pinhole.axes.T
        directions = ways / np.linalg.norm(ways, axis=1)[:, None]
        _, hit = self._caster.cast(np.tile(self._eye, (len(directions), 1)), directions)
        colours, kinds = np.unique(solid.colours, axis=0, return_inverse=True)
        normals = np.asarray(solid.mesh.face_normals)[hit]
        light = 0.5 + 0.5 * normals @ (_SKY / np.linalg.norm(_SKY))
        return Shades(
            x,
            y,
            np.where(hit >= 0, kinds.reshape(-1)[hit], -1).reshape(across.shape),
            light.reshape(across.shape),
            colours,
        )
