"""The flags that say what is simulated."""

from collections.abc import Iterable

from app.errors import InputError
from estimator import MOVING_SPEED

MAX_SPEED = 2.0
"""m/s, of what moves fastest."""


def check_simulation(speeds: Iterable[float], trials: Iterable[int], seed: int) -> None:
    """InputError where --speed, --trial or --seed cannot be simulated."""
    for speed in speeds:
        # Slower counts as rest, and takes a recording that never ends.
        if not MOVING_SPEED < speed <= MAX_SPEED:
            raise InputError(
                f"--speed must be above {MOVING_SPEED:g} and at most {MAX_SPEED:g} m/s, got "
                f"{speed:g}."
            )
    for trial in trials:
        if trial < 1:
            raise InputError(f"--trial must be 1 or more, got {trial}.")
    if seed < 0:
        raise InputError(f"--seed must be 0 or more, got {seed}.")
