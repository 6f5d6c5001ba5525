"""Scenes whose motion is known."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from estimator import all_methods

Points = NDArray[np.float64]


@dataclass(frozen=True)
class Scene:
    """A source and a target cloud of the same patches.

    Attributes:
        source: (N, 3) metres.
        target: (M, 3) metres.
        patch: (N,) number of the patch that a source point belongs to, -1 for clutter.
    """

    source: Points
    target: Points
    patch: NDArray[np.int64]


def corner(rng: np.random.Generator, size: int = 100, side: float = 0.25) -> Points:
    """Points on three faces of a cube: a shape along which ICP cannot slide."""
    points = rng.uniform(0.0, side, (size, 3))
    points[np.arange(size), np.arange(size) % 3] = 0.0
    return points


PLACES = np.array([(0, 0, 0), (1.5, 0, 0), (0, 1.5, 0), (1.5, 1.5, 0.5), (0.0, 0.0, 1.5)])


def moved_patches(rng: np.random.Generator, displacements: Points, size: int = 100) -> Scene:
    """Corners at different places, each moved by a row of `displacements` (P, 3) metres."""
    patches = [corner(rng, size) + place for place in PLACES[: len(displacements)]]
    return Scene(
        source=np.vstack(patches),
        target=np.vstack([p + d for p, d in zip(patches, displacements, strict=True)]),
        patch=np.repeat(np.arange(len(displacements)), size),
    )


def cluttered(seed: int) -> Scene:
    """Noisy blobs that move by more and less than ICP's reach, halves that stay, and stray points.

    The target sees other points of the same surfaces, so that fitness takes every value.
    Coordinates are whole multiples of 2^-20 m: moving the scene by such steps is exact.
    """
    rng = np.random.default_rng(seed)
    sources, targets, patches = [], [], []
    for number in range(int(rng.integers(2, 6))):
        centre, spread = rng.uniform(-2, 2, 3), rng.uniform(0.02, 0.25, 3)
        moving_share = rng.choice([0.0, 0.3, 0.7, 1.0])
        displacement = rng.normal(size=3) * rng.choice([0.02, 0.08, 0.2])
        sizes = rng.integers(5, 160, 2)
        source, target = (centre + rng.normal(size=(int(n), 3)) * spread for n in sizes)
        target[: int(moving_share * len(target))] += displacement
        sources.append(source)
        targets.append(target)
        patches += [number] * len(source)
    strays = rng.uniform(-3, 3, (2, 15, 3))
    return Scene(
        source=quantised(np.vstack([*sources, strays[0]])),
        target=quantised(np.vstack([*targets, strays[1]])),
        patch=np.array(patches + [-1] * 15),
    )


def quantised(points: Points) -> Points:
    return np.round(points * 2.0**20) / 2.0**20


def methods_of_points() -> list[str]:
    """Names of the methods that need no rays: what holds for every scene of points is theirs."""
    return [method.name for method in all_methods() if not method.needs_rays]
