"""Simulated frames and files for tests."""

from collections.abc import Iterator, Sequence
from pathlib import Path

from recordings import Frame
from recordings.simulation import NOISE_MODELS, SCENARIOS, Scenario, simulate, write_simulation
from robot_assets import Rig, load_rig, load_robot, parse_rig
from tests.robot_assets.coarse_rig import COARSE_RIG

ROBOT, RIG = load_robot(), load_rig()
COARSE = parse_rig(COARSE_RIG.encode(), "a test")
"""Two sensors of 4 x 4 zones, whose simulation takes a quarter of the time."""


def frames(
    scenario: Scenario,
    speed: float = 0.6,
    trial: int = 1,
    seed: int = 0,
    noise: str = "none",
    imperfections: Sequence[str] = (),
    rig: Rig = RIG,
) -> Iterator[Frame]:
    return simulate(
        scenario,
        speed=speed,
        trial=trial,
        seed=seed,
        noise=NOISE_MODELS[noise],
        imperfections=imperfections,
        robot=ROBOT,
        rig=rig,
    )


def written(
    path: Path,
    name: str,
    speed: float | None = None,
    noise: str = "none",
    imperfections: Sequence[str] = (),
    rig: Rig = RIG,
) -> Path:
    scenario = SCENARIOS[name]
    write_simulation(
        path,
        scenario,
        speed=scenario.speeds[-1] if speed is None else speed,
        trial=1,
        seed=0,
        noise=NOISE_MODELS[noise],
        imperfections=imperfections,
        robot=ROBOT,
        rig=rig,
    )
    return path
