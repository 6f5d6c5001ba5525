"""Imperfections of a simulated recording besides noise, by name."""

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True)
class Imperfection:
    """Imperfection that can be combined with any noise model.

    Attributes:
        name: as on the command line.
        text: description in one clause.
    """

    name: str
    text: str


IMPERFECTIONS = {
    imperfection.name: imperfection
    for imperfection in (
        Imperfection(
            "bias",
            "each sensor has its own offset and scale error, one sigma 10 mm and 1 %",
        ),
        Imperfection(
            "border_zones",
            "noise is 1.15 to 1.2 times as large at the border, 1.33 to 1.47 at the corners",
        ),
        Imperfection(
            "fixed_pattern",
            "each zone has its own constant error, one sigma 1 mm, 3 mm at the corners",
        ),
        Imperfection(
            "dropouts",
            "readings of wood and of screens drop out for several frames: a two-state Markov "
            "chain, valid to valid with probability 0.943, invalid to valid with 0.038",
        ),
        Imperfection(
            "flying_pixels",
            "zones across a step of more than 0.6 m are valid with probability 0.64, and read the "
            "distance in front, behind or between",
        ),
        Imperfection(
            "ramps",
            "motions accelerate for 0.25 s and decelerate for 0.25 s, instead of instantly",
        ),
        Imperfection("dropped_frames", "5 % of the frames are lost"),
        Imperfection(
            "stamp_jitter",
            "stamps deviate from the time of the readings, one sigma 4 ms",
        ),
    )
}
"""{name: imperfection}."""


def in_order(names: Iterable[str]) -> tuple[str, ...]:
    """The names once each, in the order of IMPERFECTIONS.

    Raises:
        ValueError: a name is unknown.
    """
    wanted = set(names)
    if unknown := wanted - set(IMPERFECTIONS):
        raise ValueError(
            f"There is no imperfection {', '.join(sorted(unknown))}; there are "
            f"{', '.join(IMPERFECTIONS)}."
        )
    return tuple(name for name in IMPERFECTIONS if name in wanted)


class Streams:
    """Independent random streams, one per imperfection, so that none changes another's numbers.

    Args:
        key: seed of the recording, whole numbers below 2**32.
    """

    # Separates the key from the name; parts of the key are bytes or counts, never this number.
    _BETWEEN = 2**32 - 1

    def __init__(self, key: Iterable[int]) -> None:
        self._key = [*key]

    def of(self, name: str) -> np.random.Generator:
        """New generator at the start of an imperfection's stream."""
        return np.random.default_rng([*self._key, self._BETWEEN, *name.encode()])
