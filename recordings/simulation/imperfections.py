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


class Bias:
    """Each sensor errs in a way of its own that does not change.

    Of a VL53L5CX against motion capture the scale is off by 0.5 % and the offset by some
    millimetres; the datasheet's accuracy leaves room for twice that.

    Args:
        sensors: their number.
        rng: stream of random numbers.
    """

    OFFSET, SCALE = 0.010, 0.01
    """One sigma over the sensors: metres, and share of the distance."""

    def __init__(self, sensors: int, rng: np.random.Generator) -> None:
        self._offset = self.OFFSET * rng.standard_normal((sensors, 1, 1))
        self._scale = self.SCALE * rng.standard_normal((sensors, 1, 1))

    def error(self, readings: np.ndarray) -> np.ndarray:
        """Errors (S, rows, columns) in metres of readings in metres."""
        return self._offset + self._scale * readings
