"""Random clouds of kinds that clustering finds hard."""

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

Cloud = NDArray[np.float64]
Make = Callable[[np.random.Generator, Cloud], Cloud]


def _half_again(rng: np.random.Generator, cloud: Cloud) -> Cloud:
    again = rng.uniform(size=len(cloud)) < 0.3
    cloud[again] = cloud[rng.integers(0, len(cloud), again.sum())]
    return cloud


def _lattice(_: np.random.Generator, cloud: Cloud) -> Cloud:
    side = np.arange(float(np.ceil(len(cloud) ** (1 / 3)))) * 0.1
    return np.stack(np.meshgrid(side, side, side), axis=-1).reshape(-1, 3)


KINDS: dict[str, Make] = {
    "islands": lambda _, cloud: cloud,
    "one cloud": lambda rng, cloud: rng.normal(size=cloud.shape),
    "millimetres": lambda _, cloud: cloud.round(3),
    "centimetres": lambda _, cloud: cloud.round(2),
    "decimetres": lambda _, cloud: cloud.round(1),
    "float32": lambda _, cloud: cloud.astype(np.float32).astype(np.float64),
    "duplicates": _half_again,
    "integers": lambda rng, cloud: rng.integers(0, 6, cloud.shape).astype(np.float64),
    "lattice": _lattice,
    "plane": lambda _, cloud: cloud * (1.0, 1.0, 0.0),
    "twice": lambda _, cloud: np.vstack([cloud, cloud]),
    "far apart": lambda rng, cloud: cloud + rng.integers(0, 3, (len(cloud), 1)) * 1e8,
    "any scale": lambda rng, cloud: cloud * 10.0 ** rng.integers(-6, 91),
    "offset": lambda _, cloud: cloud + 1e6,
    "line": lambda rng, cloud: np.outer(cloud[:, 0], rng.normal(size=3)),
    "all equal": lambda _, cloud: np.ones_like(cloud) * cloud[0],
    "zeros among them": lambda _, cloud: np.vstack([cloud, np.zeros_like(cloud)]),
    "integers on a line": lambda rng, cloud: np.outer(
        rng.integers(0, 50, len(cloud)), [1.0, 0.0, 0.0]
    ),
}


def cloud_of(kind: str, rng: np.random.Generator, most: int = 500) -> Cloud:
    """A random cloud of 5 to `most` points or, of some kinds, twice as many."""
    size = int(rng.integers(5, most))
    centres = rng.normal(size=(int(rng.integers(1, 12)), 3)) * 3
    spread = rng.uniform(0.02, 0.8)
    islands = centres[rng.integers(0, len(centres), size)] + rng.normal(size=(size, 3)) * spread
    return KINDS[kind](rng, islands)
