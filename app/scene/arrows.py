"""Arrows drawn as lines, whose colour no lamp changes."""

import numpy as np
import viser
from numpy.typing import NDArray

_BARBS = 6
_HEAD_SHARE = 0.45  # of an arrow's length that its head takes at most
_MOST_GAP = 0.3  # of an arrow's length before its shaft
_SPREAD = 0.32  # radius of a head, as a fraction of its length


class Arrows:
    """A set of arrows: the shafts, and below them in the scene graph the heads.

    Args:
        scene: to draw in.
        node: name of the shafts' node.
    """

    def __init__(self, scene: viser.SceneApi, node: str) -> None:
        # Colours per vertex from the start: viser's page ignores a change to or from a single one.
        none = np.zeros((0, 2, 3), dtype=np.float32)
        colour = np.zeros((0, 2, 3), dtype=np.uint8)
        self._shafts = scene.add_line_segments(node, none, colour, thickness_units="world")
        self._heads = scene.add_line_segments(
            f"{node}/heads", none, colour, thickness_units="world"
        )
        self._drawn: NDArray[np.float64] = np.zeros((0, 2, 3))
        self._colours: NDArray[np.uint8] = np.zeros((0, 3), dtype=np.uint8)
        self._head, self._gap = 0.02, 0.0

    def show(self, segments: NDArray[np.float64], colours: NDArray[np.uint8]) -> None:
        """Draw arrows.

        Args:
            segments: (N, 2, 3) where each begins and ends, metres.
            colours: (N, 3), or one (3,) for all.
        """
        colours = np.broadcast_to(linear(colours), (len(segments), 3))
        if np.array_equal(segments, self._drawn) and np.array_equal(colours, self._colours):
            return
        self._drawn, self._colours = segments, colours
        self._shafts.colors = np.repeat(colours[:, None], 2, axis=1)
        self._heads.colors = np.repeat(np.repeat(colours, _BARBS, axis=0)[:, None], 2, axis=1)
        self._draw()

    def fit(self, thickness: float, head: float, gap: float) -> None:
        """Set sizes in metres.

        Args:
            thickness: of the lines.
            head: length of heads at most.
            gap: between an arrow's beginning and its shaft, so that a point there stays free.
        """
        self._shafts.thickness = self._heads.thickness = thickness
        self._head, self._gap = head, gap
        self._draw()

    def _draw(self) -> None:
        self._shafts.points = shafts(self._drawn, self._gap).astype(np.float32)
        self._heads.points = barbs(self._drawn, self._head).astype(np.float32)


def shafts(segments: NDArray[np.float64], gap: float) -> NDArray[np.float64]:
    """Arrows (N, 2, 3) that begin after a gap in metres, which is less in short ones."""
    along = segments[:, 1] - segments[:, 0]
    length = np.maximum(np.linalg.norm(along, axis=1, keepdims=True), 1e-12)
    tails = segments[:, 0] + along * np.minimum(gap / length, _MOST_GAP)
    return np.stack([tails, segments[:, 1]], axis=1)


def linear(colours: NDArray[np.uint8]) -> NDArray[np.uint8]:
    """Colours (..., 3) of lines as viser's page takes them, so that they look as given.

    It takes those of vertices as amounts of light, and all others as sRGB (IEC 61966-2-1).
    """
    parts = colours / 255
    light = np.where(parts <= 0.04045, parts / 12.92, ((parts + 0.055) / 1.055) ** 2.4)
    return (255 * light).round().astype(np.uint8)


def barbs(segments: NDArray[np.float64], longest: float) -> NDArray[np.float64]:
    """Lines (6 N, 2, 3) of the heads of arrows (N, 2, 3), each from the tip backwards.

    Args:
        segments: tails and tips, metres.
        longest: length of a head at most, metres; short arrows have shorter ones.
    """
    tips = segments[:, 1]
    along = tips - segments[:, 0]
    length = np.linalg.norm(along, axis=1, keepdims=True)
    along = along / np.maximum(length, 1e-12)
    head = np.minimum(longest, _HEAD_SHARE * length)
    # Any direction that is not the arrow's own gives one across it.
    other = np.where(np.abs(along[:, 2:]) < 0.9, [[0.0, 0.0, 1.0]], [[1.0, 0.0, 0.0]])
    aside = np.cross(along, other)
    aside = aside / np.maximum(np.linalg.norm(aside, axis=1, keepdims=True), 1e-12)
    across = np.cross(along, aside)
    turns = np.linspace(0.0, 2 * np.pi, _BARBS, endpoint=False)[None, :, None]
    around = np.cos(turns) * aside[:, None] + np.sin(turns) * across[:, None]
    ends = (tips - head * along)[:, None] + _SPREAD * head[:, None] * around
    starts = np.broadcast_to(tips[:, None], ends.shape)
    return np.stack([starts, ends], axis=2).reshape(-1, 2, 3)
