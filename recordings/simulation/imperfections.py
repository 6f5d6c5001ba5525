"""What may be wrong with a simulated recording besides noise, each by a name of its own."""

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True)
class Imperfection:
    """Something that can be switched on with any noise model.

    Attributes:
        name: as on the command line.
        text: what it does, in one clause.
    """

    name: str
    text: str


IMPERFECTIONS = {
    imperfection.name: imperfection
    for imperfection in (
        Imperfection(
            "bias",
            "each sensor errs by a constant and a share of the distance of its own, one sigma "
            "10 mm and 1 %",
        ),
        Imperfection(
            "border_zones",
            "noise is 1.15 to 1.2 times as large at the border, 1.33 to 1.47 at the corners",
        ),
        Imperfection(
            "fixed_pattern",
            "each zone errs by a constant of its own, one sigma 1 mm and 3 mm at the corners",
        ),
        Imperfection(
            "dropouts",
            "readings of wood and of screens drop out for a while: valid stays valid by 0.943, "
            "invalid becomes valid by 0.038",
        ),
        Imperfection(
            "flying_pixels",
            "zones across a step of more than 0.6 m are valid by 0.64, and read what is in front, "
            "what is behind or something between",
        ),
        Imperfection(
            "ramps",
            "what moves takes 0.25 s to reach its speed and 0.25 s to stop, instead of jumping",
        ),
        Imperfection("dropped_frames", "frames are lost, 5 % of them"),
        Imperfection(
            "stamp_jitter",
            "readings are stamped earlier or later than they were taken, one sigma 4 ms",
        ),
    )
}
"""{name: imperfection}, in the order in which they are named."""


def in_order(names: Iterable[str]) -> tuple[str, ...]:
    """The names once each, in the order of IMPERFECTIONS.

    Raises:
        ValueError: there is no imperfection of some name.
    """
    wanted = set(names)
    if unknown := wanted - set(IMPERFECTIONS):
        raise ValueError(
            f"There is no imperfection {', '.join(sorted(unknown))}; there are "
            f"{', '.join(IMPERFECTIONS)}."
        )
    return tuple(name for name in IMPERFECTIONS if name in wanted)


class Streams:
    """Random numbers, a stream for each imperfection, so that none changes another's.

    Args:
        key: what tells recordings apart, whole numbers below 2**32.
    """

    # Parts of the key are bytes or counts; this number parts the name from them.
    _BETWEEN = 2**32 - 1

    def __init__(self, key: Iterable[int]) -> None:
        self._key = [*key]

    def of(self, name: str) -> np.random.Generator:
        """The stream of an imperfection, from its start."""
        return np.random.default_rng([*self._key, self._BETWEEN, *name.encode()])
