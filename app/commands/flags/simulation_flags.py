"""The flags that say what is simulated."""

from collections.abc import Iterable

from app.errors import InputError
from estimator import MOVING_SPEED
from recordings.simulation import PAPER_SCENARIOS, SCENARIOS, Repetition

MAX_SPEED = 2.0
"""Largest speed, m/s."""
MAX_DURATION = 86_400.0
"""Longest recording, seconds."""
MAX_POSE_RATE = 1000
"""Most joints and poses per second."""
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


def repetition_of(duration: float | None, pose_rate: int) -> Repetition | None:
    """What --duration and --pose-rate ask for, None without; InputError where it cannot be."""
    if duration is None:
        if pose_rate:
            raise InputError("--pose-rate needs --duration.")
        return None
    if not 0.0 < duration <= MAX_DURATION:
        raise InputError(
            f"--duration must be above 0 and at most {MAX_DURATION:g} s, got {duration:g}."
        )
    if not 0 <= pose_rate <= MAX_POSE_RATE:
        raise InputError(f"--pose-rate must be 0 to {MAX_POSE_RATE} Hz, got {pose_rate}.")
    return Repetition(duration, pose_rate)
