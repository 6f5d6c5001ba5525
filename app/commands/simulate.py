"""`tofscope simulate`: recordings of the paper's scenarios and more, simulated by ray casting."""

import argparse
from collections.abc import Sequence
from functools import partial
from pathlib import Path

from app.commands.flags.simulation_flags import (
    ALL,
    MAX_DURATION,
    MAX_POSE_RATE,
    MAX_SPEED,
    MORE,
    check_simulation,
    repetition_of,
    scenario_names,
)
from app.errors import InputError
from recordings import RecordingError, open_recording
from recordings.simulation import (
    IMPERFECTIONS,
    NOISE_MODELS,
    PAPER_SCENARIOS,
    SCENARIOS,
    TRIALS,
    Scenario,
    write_repeated,
    write_simulation,
)
from robot_assets import load_rig, load_robot
from robot_assets.printable import printable

_ENDING = ".mcap"
_ONE_TRIAL = 1


def add_flags(parser: argparse.ArgumentParser) -> None:
    """Describe the subcommand, and add its flags."""
    scenarios = "; ".join(f"{s.name}: {s.text}" for s in SCENARIOS.values())
    noise = "; ".join(f"{n.name}: {n.text}" for n in NOISE_MODELS.values())
    imperfections = "; ".join(f"{i.name}: {i.text}" for i in IMPERFECTIONS.values())
    parser.description = (
        "Simulate the paper's experiments, and more: a Panda with sensors in a lab, and a "
        "mannequin carried by a second Panda, or something else that moves, at 15 Hz, with the "
        "truth of every point. The same arguments give the same recording. A simulated "
        "recording that exists under the name is replaced; any other file is left alone."
    )
    parser.add_argument(
        "scenarios",
        nargs="+",
        choices=[*SCENARIOS, ALL, MORE],
        metavar="SCENARIO",
        help=(
            f"{scenarios}; {ALL}: the paper's {', '.join(PAPER_SCENARIOS)}; {MORE}: the others"
        ).replace("%", "%%"),
    )
    parser.add_argument(
        "--out",
        type=Path,
        required=True,
        metavar="FILE_OR_FOLDER",
        help=(
            "a FILE.mcap for a single recording; else a folder, made where it is missing, for "
            "recordings named like towards_0.20_1.mcap (scenario, speed, trial)"
        ),
    )
    parser.add_argument(
        "--speed",
        nargs="+",
        type=float,
        metavar="M/S",
        help=(
            f"speeds of what moves, up to {MAX_SPEED:g} m/s; where nothing does it is 0 all the "
            f"same (default: into a folder those of each scenario, which are {_speeds()}; into a "
            f"file the one in the middle)"
        ),
    )
    parser.add_argument(
        "--trial",
        nargs="+",
        type=int,
        metavar="NUMBER",
        help=(
            f"trials, which differ in noise and in where the mannequin starts by about a "
            f"centimetre (default: {TRIALS[0]} to {TRIALS[-1]} into a folder, {_ONE_TRIAL} into "
            "a file)"
        ),
    )
    parser.add_argument(
        "--seed", type=int, default=0, help="seed of all random numbers (default 0)"
    )
    parser.add_argument(
        "--noise",
        choices=list(NOISE_MODELS),
        default="paper",
        help=f"model of the sensors' errors (default paper); {noise}".replace("%", "%%"),
    )
    parser.add_argument(
        "--imperfections",
        nargs="+",
        choices=list(IMPERFECTIONS),
        default=[],
        metavar="NAME",
        help=f"what else is wrong (default nothing); {imperfections}".replace("%", "%%"),
    )
    parser.add_argument(
        "--rig",
        type=Path,
        metavar="FILE",
        help="rig file (TOML) of the sensors on the Panda (default: the paper's 24 sensors)",
    )
    parser.add_argument(
        "--duration",
        type=float,
        metavar="SECONDS",
        help=(
            f"make a recording that lasts so long, up to {MAX_DURATION:g} s: rays are cast once, "
            f"and the frames of the scenario repeated to and fro, which the recording says "
            f"(default: the scenario once)"
        ),
    )
    parser.add_argument(
        "--pose-rate",
        type=int,
        default=0,
        metavar="HZ",
        help=(
            f"with --duration: joints and poses per second between the frames, up to "
            f"{MAX_POSE_RATE} (default: those of the frames alone)"
        ),
    )


def run(options: argparse.Namespace) -> int:
    """Run the subcommand."""
    single = options.out.suffix == _ENDING and not options.out.is_dir()
    trials = options.trial or ([_ONE_TRIAL] if single else TRIALS)
    check_simulation(options.speed or [], trials, options.seed)
    repetition = repetition_of(options.duration, options.pose_rate)
    robot, rig = load_robot(), load_rig(options.rig)
    rig.check_links(robot.links, robot.name)
    wanted = [
        (scenario, speed, trial)
        for scenario in map(SCENARIOS.__getitem__, scenario_names(options.scenarios))
        for speed in dict.fromkeys(_speeds_of(scenario, options.speed, single))
        for trial in dict.fromkeys(trials)
    ]
    if single and len(wanted) > 1:
        raise InputError(
            f"{options.out} is a file, which holds one recording, and {len(wanted)} are asked "
            f"for; give --out a folder, or one scenario, speed and trial."
        )
    paths = {
        (scenario.name, speed, trial): options.out
        if single
        else options.out / f"{scenario.name}_{_shown(speed)}_{trial}{_ENDING}"
        for scenario, speed, trial in wanted
    }
    for path in paths.values():
        _check_replaceable(path)
    if not single:
        _make_folder(options.out)
    for (name, speed, trial), path in paths.items():
        write = partial(write_repeated, repetition=repetition) if repetition else write_simulation
        count = write(
            path,
            SCENARIOS[name],
            speed=speed,
            trial=trial,
            seed=options.seed,
            noise=NOISE_MODELS[options.noise],
            imperfections=tuple(options.imperfections),
            robot=robot,
            rig=rig,
        )
        said = f"{path}: {count} frames, {path.stat().st_size / 1e6:.1f} MB"
        print(printable(said), flush=True)
    return 0


def _speeds_of(scenario: Scenario, asked: list[float] | None, single: bool) -> Sequence[float]:
    if scenario.still or not (asked or single):
        return scenario.speeds
    return asked or [scenario.speeds[len(scenario.speeds) // 2]]


def _speeds() -> str:
    """Text of the scenarios' speeds."""
    by_speeds: dict[tuple[float, ...], list[str]] = {}
    for scenario in SCENARIOS.values():
        if not scenario.still:
            by_speeds.setdefault(scenario.speeds, []).append(scenario.name)
    return ", ".join(
        f"{' '.join(_shown(speed) for speed in speeds)} for {' '.join(names)}"
        for speeds, names in by_speeds.items()
    )


def _shown(speed: float) -> str:
    """A speed with two decimals, or with more where it has more."""
    two = f"{speed:.2f}"
    return two if float(two) == speed else f"{speed:g}"


def _check_replaceable(path: Path) -> None:
    """Refuse to overwrite a file that is not a simulated recording, such as measured data."""
    if not path.exists():
        return
    try:
        with open_recording(path) as recording:
            if recording.simulated:
                return
    except RecordingError:
        pass
    raise InputError(
        f"{path} exists and is not a simulated recording; remove it or give another --out."
    )


def _make_folder(folder: Path) -> None:
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise InputError(f"The folder {folder} cannot be made: {error.strerror}.") from error
