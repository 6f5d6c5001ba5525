"""The lab around the robots, at rest.

Algorithm 1 finds no clusters without static surroundings in view, and furniture within arm's reach
is most of the view of a sensorised arm.
"""

from dataclasses import dataclass

from recordings.simulation.body import Piece
from recordings.simulation.surface import CARDBOARD, CLOTH, PAINT, SCREEN, STEEL, WOOD

_FLOOR = -0.75  # height below the robots' bases, metres


@dataclass(frozen=True)
class _Box:
    """Centre (x, y) and height of the lower face above the floor, and size (x, y, z), in metres."""

    position: tuple[float, float, float]
    size: tuple[float, float, float]


_ROOM = (
    _Box((0.2, 0.5, -0.05), (5.0, 5.2, 0.05)),
    _Box((0.2, 0.5, 2.70), (5.0, 5.2, 0.05)),
    _Box((0.2, -2.1, 0.0), (5.0, 0.1, 2.7)),
    _Box((0.2, 3.1, 0.0), (5.0, 0.1, 2.7)),
    _Box((-2.3, 0.5, 0.0), (0.1, 5.2, 2.7)),
    _Box((2.7, 0.5, 0.0), (0.1, 5.2, 2.7)),
)
# The sensorised robot stands near the front edge of its bench, the second one on a pedestal.
_BENCH = (
    _Box((0.0, -0.25, 0.70), (1.5, 0.8, 0.05)),
    _Box((0.0, -0.25, 0.12), (1.3, 0.6, 0.03)),
    *(_Box((x, y, 0.0), (0.06, 0.06, 0.70)) for x in (-0.68, 0.68) for y in (-0.58, 0.08)),
    _Box((0.45, -0.40, 0.15), (0.30, 0.36, 0.40)),
)
_PEDESTAL = (
    _Box((0.0, 1.485, 0.0), (0.5, 0.5, 0.04)),
    _Box((0.0, 1.485, 0.04), (0.28, 0.28, 0.67)),
    _Box((0.0, 1.485, 0.71), (0.4, 0.4, 0.04)),
)
_CABINET = (
    _Box((1.17, -0.1, 0.0), (0.50, 1.1, 0.10)),
    _Box((1.15, -0.38, 0.10), (0.50, 0.54, 1.85)),
    _Box((1.15, 0.18, 0.10), (0.50, 0.54, 1.85)),
    _Box((0.89, -0.14, 0.95), (0.02, 0.03, 0.20)),
    _Box((0.89, -0.06, 0.95), (0.02, 0.03, 0.20)),
)
_SHELF = (
    _Box((-1.38, -0.2, 0.0), (0.02, 1.2, 1.95)),
    _Box((-1.15, -0.81, 0.0), (0.46, 0.02, 1.95)),
    _Box((-1.15, 0.41, 0.0), (0.46, 0.02, 1.95)),
    *(_Box((-1.15, -0.2, z), (0.46, 1.2, 0.025)) for z in (0.10, 0.55, 1.00, 1.45, 1.93)),
)
_PARCELS = (
    _Box((-1.12, -0.55, 0.575), (0.38, 0.40, 0.30)),
    _Box((-1.10, 0.10, 0.575), (0.36, 0.50, 0.34)),
    _Box((-1.10, -0.45, 1.025), (0.36, 0.60, 0.32)),
    _Box((-1.14, 0.15, 1.025), (0.40, 0.36, 0.28)),
    _Box((-1.10, -0.50, 1.475), (0.36, 0.44, 0.36)),
    _Box((-1.12, 0.05, 1.475), (0.38, 0.50, 0.30)),
)
_RACK = (
    _Box((-0.33, -1.15, 0.0), (0.60, 0.50, 1.90)),
    _Box((0.33, -1.15, 0.0), (0.66, 0.50, 1.05)),
    _Box((0.30, -1.18, 1.05), (0.48, 0.40, 0.42)),
    _Box((0.34, -1.14, 1.47), (0.42, 0.42, 0.36)),
)
_DESK = (
    _Box((-1.75, 2.0, 0.70), (0.80, 1.60, 0.04)),
    _Box((-1.75, 1.25, 0.0), (0.76, 0.04, 0.70)),
    _Box((-1.75, 2.75, 0.0), (0.76, 0.04, 0.70)),
)
_MONITOR = (
    _Box((-1.95, 2.0, 0.84), (0.04, 0.62, 0.38)),
    _Box((-1.97, 2.0, 0.74), (0.16, 0.22, 0.10)),
)
_CHAIR = (
    _Box((-1.10, 1.9, 0.44), (0.46, 0.46, 0.06)),
    _Box((-0.90, 1.9, 0.50), (0.05, 0.42, 0.45)),
    _Box((-1.10, 1.9, 0.0), (0.08, 0.08, 0.44)),
)


_FURNITURE = (
    (_ROOM, PAINT),
    (_BENCH, WOOD),
    (_PEDESTAL, STEEL),
    (_CABINET, PAINT),
    (_SHELF, WOOD),
    (_PARCELS, CARDBOARD),
    (_RACK, STEEL),
    (_DESK, WOOD),
    (_MONITOR, SCREEN),
    (_CHAIR, CLOTH),
)


def surroundings(pedestal: bool = True) -> list[Piece]:
    """Room and furniture as closed meshes in the fixed frame.

    Args:
        pedestal: whether to include the second robot's pedestal.
    """
    import trimesh

    pieces: list[Piece] = []
    for boxes, surface in _FURNITURE:
        if boxes is _PEDESTAL and not pedestal:
            continue
        for box in boxes:
            mesh = trimesh.creation.box(box.size)
            x, y, height = box.position
            mesh.apply_translation((x, y, _FLOOR + height + box.size[2] / 2))
            pieces.append(Piece(mesh, surface))
    return pieces
