"""Windows that benchmarks estimate: pairs of the samples and of recordings made for them."""

import tempfile
from dataclasses import replace
from pathlib import Path

import robot_assets
from estimator import Parameters, Stages, Window, window_of_pair
from recordings import open_recording, sample_paths
from recordings.simulation import NOISE_MODELS, SCENARIOS
from recordings.simulation.simulate import write_simulation
from robot_assets import Rig, load_rig, load_robot, parse_rig

WHOLE = 45
"""Pairs of the recording that is estimated as a whole."""
_SLOW, _NORMAL = 0.14, 0.25  # m/s; the slow one lasts for more than 45 pairs
_RIG = Path(robot_assets.__file__).parent / "rigs" / "paper.toml"


def windows_of(path: Path, n: int = Parameters().n) -> list[Window]:
    """The pairs (k-n, k) of a recording, in order."""
    with open_recording(path) as recording:
        clouds = [recording.cloud(k) for k in range(len(recording))]
        stamps = recording.stamps
        return [
            window_of_pair(clouds[k - n], clouds[k], float(stamps[k] - stamps[k - n]))
            for k in range(n, len(clouds))
        ]


def sample_windows() -> list[Window]:
    """Every fourth pair of each sample."""
    return [window for path in sample_paths() for window in windows_of(path)[::4]]


def write_whole(path: Path) -> None:
    """Simulate a recording of at least `WHOLE` pairs with the paper's 24 sensors."""
    _write(path, load_rig(), _SLOW)


def whole_windows() -> list[Window]:
    """The first `WHOLE` pairs of the recording that `write_whole` makes."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "whole.mcap"
        write_whole(path)
        return windows_of(path)[:WHOLE]


def wide_rig() -> Rig:
    """The paper's rig with 33, 33 and 34 sensors on its rings in place of eight each."""
    text = _RIG.read_text()
    for count in (33, 33, 34):
        text = text.replace("count = 8", f"count = {count}", 1)
    return parse_rig(text.encode(), "the rig of 100 sensors")


def wide_windows() -> list[Window]:
    """Every fourth pair of a simulated recording with 100 sensors."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "wide.mcap"
        _write(path, wide_rig(), _NORMAL)
        return windows_of(path)[::4]


def fresh(window: Window) -> Window:
    """A window of which nothing is kept."""
    return replace(window, stages=Stages())


def _write(path: Path, rig: Rig, speed: float) -> None:
    write_simulation(
        path,
        SCENARIOS["robot_moving"],
        speed=speed,
        trial=2,
        seed=0,
        noise=NOISE_MODELS["paper"],
        imperfections=(),
        robot=load_robot(),
        rig=rig,
    )
