"""The flags that say what is simulated."""

from collections.abc import Iterable

from app.errors import InputError
from estimator import MOVING_SPEED
from recordings.simulation import PAPER_SCENARIOS, SCENARIOS

MAX_SPEED = 2.0
"""Largest speed, m/s."""
ALL, MORE = "all", "more"
"""Groups of scenarios: the paper's, and the others."""


def scenario_names(names: Iterable[str]) -> tuple[str, ...]:
    """Names of scenarios, each once, with groups replaced by their members."""
    groups = {ALL: PAPER_SCENARIOS, MORE: [n for n in SCENARIOS if n not in PAPER_SCENARIOS]}
    return tuple(dict.fromkeys(n for name in names for n in groups.get(name, [name])))


def check_simulation(speeds: Iterable[float], trials: Iterable[int], seed: int) -> None:
    """Raise InputError where --speed, --trial or --seed cannot be simulated."""
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
