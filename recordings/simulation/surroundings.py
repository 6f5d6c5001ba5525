"""The lab around the robots: what never moves.

Boxes and cylinders at the places where a lab has them. They matter as much as the mannequin does:
without anything static in sight Algorithm 1 finds no clusters.
"""

import trimesh

_FLOOR = -0.75  # height below the robots' bases, metres

# name: middle (x, y) and height of its lower side above the floor, size (x, y, z); metres
_BOXES = {
    "floor": ((0.2, 0.5, -0.05), (5.0, 5.2, 0.05)),
    "ceiling": ((0.2, 0.5, 2.70), (5.0, 5.2, 0.05)),
    "wall behind": ((0.2, -2.1, 0.0), (5.0, 0.1, 2.7)),
    "wall ahead": ((0.2, 3.1, 0.0), (5.0, 0.1, 2.7)),
    "wall left": ((-2.3, 0.5, 0.0), (0.1, 5.2, 2.7)),
    "wall right": ((2.7, 0.5, 0.0), (0.1, 5.2, 2.7)),
    "bench top": ((0.0, -0.25, 0.70), (1.4, 0.8, 0.05)),
    "bench box": ((0.0, -0.25, 0.0), (1.2, 0.6, 0.70)),
    "pedestal": ((0.0, 1.45, 0.0), (0.4, 0.4, 0.75)),
    "cabinet": ((1.15, -0.1, 0.0), (0.5, 1.0, 1.9)),
    "shelf": ((-1.15, -0.2, 0.0), (0.5, 1.2, 1.9)),
    "rack": ((0.0, -1.1, 0.0), (1.2, 0.4, 1.9)),
}


def surroundings() -> dict[str, trimesh.Trimesh]:
    """{name: mesh in the fixed frame} of everything that stands still."""
    pieces: dict[str, trimesh.Trimesh] = {}
    for name, ((x, y, height), size) in _BOXES.items():
        piece = trimesh.creation.box(size)
        piece.apply_translation((x, y, _FLOOR + height + size[2] / 2))
        pieces[name] = piece
    return pieces
