"""`tofscope study`: the paper's tables and its sweep of n, simulated or on recordings."""

import argparse
import shlex
import sys
from collections.abc import Iterable
from dataclasses import replace
from pathlib import Path
from time import monotonic
from typing import TypeVar

from app.analysis.method_files import method_files
from app.commands.flags.engine_flags import add_engine_flag, choose_engine
from app.commands.flags.execution_flags import add_execution_flags, check_jobs
from app.commands.flags.parameter_flags import (
    add_parameter_flags,
    method_name,
    parameters_from,
)
from app.commands.flags.recording_flags import add_recording_flags, opening_from, recording_paths
from app.commands.flags.simulation_flags import ALL, check_simulation, scenario_names
from app.commands.flags.study_flags import add_source_flags
from app.commands.signals import STOPPED
from app.errors import InputError
from app.study.conditions import truth_frame_text
from app.study.execution import outcomes
from app.study.plan import METHODS, SWEEP, Plan
from app.study.progress import Progress, duration
from app.study.report import PAGE, Study, check_folder, write_report
from app.study.software import software_digest
from app.study.store import Store
from app.study.text_files import for_terminal
from app.study.work import Recorded, Work
from app.terminal.tables import show
from estimator import method_names
from recordings.simulation import IMPERFECTIONS, TRIALS
from robot_assets import load_rig
from robot_assets.printable import printable

_T = TypeVar("_T")
_SHOWN = ("table_1", "table_2")
_OF_SIMULATION = ("scenario", "speed", "trial", "seed", "noise", "imperfections", "ablation")


def add_flags(parser: argparse.ArgumentParser) -> None:
    """Describe the subcommand, and add its flags."""
    parser.description = (
        "Make the paper's study again: simulate its 60 recordings (three scenarios, four "
        "speeds, five trials), run every method on them, and write Tables I and II beside the "
        "paper's own numbers, the sweep of n as a figure, further tables, and a page to read "
        f"first, {PAGE}. With --recordings the same for recordings that are there. What is "
        "finished is kept in the folder: the same command goes on where it was stopped. The "
        "exit code is 1 where nothing could be evaluated."
    )
    parser.add_argument(
        "--out", type=Path, required=True, metavar="FOLDER", help="where everything is written"
    )
    parser.add_argument(
        "--method",
        dest="methods",
        nargs="+",
        type=method_name,
        choices=method_names(),
        default=METHODS,
        help=(
            f"methods in the same tables (default {' '.join(METHODS)}); one of your own: "
            "FILE.py:NAME"
        ),
    )
    parser.add_argument(
        "--sweep",
        nargs="*",
        type=int,
        default=SWEEP,
        metavar="N",
        help=f"values of n that are tried (default {SWEEP[0]} to {SWEEP[-1]}; none: no sweep)",
    )
    add_source_flags(parser)
    add_execution_flags(parser)
    add_recording_flags(parser)
    add_engine_flag(parser)
    add_parameter_flags(parser, leave_out=("method",))


def run(options: argparse.Namespace) -> int:
    """Run the subcommand."""
    begin = monotonic()
    plan = _plan(options)
    check_jobs(options)
    check_folder(options.out)
    choose_engine(options.engine)
    store = Store(options.out / "results", software_digest(plan.method_files))
    works, twice = _once_each(store, plan.works())
    left = [work for work in map(store.missing, works) if work]
    if len(left) < len(works):
        print(f"{len(works) - len(left)} of {len(works)} recordings are known from before.")
    failures = _execute(options, store, left, len(works))
    if failures is None:
        return STOPPED
    finished = [outcome for work in works if (outcome := store.finished(work))]
    failures += twice
    failures += [
        f"{outcome.source.name} has no truth, so there is nothing to compare with."
        for outcome in finished
        if not any(result.metrics for result in outcome.results)
    ]
    for failure in failures:
        print(f"Not evaluated: {printable(failure)}", file=sys.stderr)
    if not any(result.metrics for outcome in finished for result in outcome.results):
        return 1
    estimated = monotonic()
    study = Study(plan, finished, failures, _command(), estimated - begin)
    for table in write_report(study, options.out):
        if table.name in _SHOWN or (table.name == "recordings" and plan.recordings):
            print(printable(table.title))
            show(for_terminal(table))
            print()
    if caveat := truth_frame_text(plan).strip():
        print(printable(caveat))
    making = sum(outcome.seconds for outcome in finished)
    estimating = sum(result.seconds for outcome in finished for result in outcome.results)
    print(
        f"{duration(estimated - begin)} on the clock for the recordings (simulating or opening "
        f"{duration(making)}, estimating {duration(estimating)} of one core, earlier runs "
        f"included), {duration(monotonic() - estimated)} for tables and figure."
    )
    print(printable(f"Read first: {options.out / PAGE}"))
    return 0


def _once_each(store: Store, works: list[Work]) -> tuple[list[Work], list[str]]:
    """Works with distinct recordings, and sentences on those that are copies."""
    first: dict[str, Work] = {}
    twice: list[str] = []
    for work in works:
        there = first.setdefault(store.digest(work.source), work)
        if there is not work:
            twice.append(
                f"{work.source.name} has the same content as {there.source.name}, and counts once."
            )
    return list(first.values()), twice


def _execute(
    options: argparse.Namespace, store: Store, left: list[Work], total: int
) -> list[str] | None:
    """Run the remaining works; return failures as sentences, None when interrupted."""
    failures: list[str] = []
    unkept: list[str] = []
    progress = Progress(left, total, 1 if options.dask else options.jobs)
    running = outcomes(left, options.jobs, options.dask)
    try:
        for outcome in running:
            if outcome.failure:
                failures.append(outcome.failure)
            else:
                try:
                    store.keep(outcome)
                except InputError as error:
                    unkept.append(str(error))
            progress.advance(outcome.source)
    except KeyboardInterrupt:
        progress.close()
        print(
            f"Stopped: {progress.finished - len(unkept)} of {total} recordings are finished and "
            "kept; the same command goes on from there.",
            file=sys.stderr,
        )
        return None
    finally:
        running.close()
        progress.close()
        for said in unkept:
            print(f"Result not stored for later runs: {printable(said)}", file=sys.stderr)
    return failures


def _plan(options: argparse.Namespace) -> Plan:
    parameters = parameters_from(options)
    given = [name for name in _OF_SIMULATION if name in options]
    for n in options.sweep:
        replace(parameters, n=n)  # ParameterError where it is out of range
    methods = _once(options.methods)
    plan = Plan(
        parameters,
        methods=methods,
        sweep=_once(options.sweep),
        method_files=method_files(methods),
    )
    if options.recordings:
        if given:
            raise InputError(
                f"--{given[0]} says how recordings are simulated, and --recordings takes them as "
                "they are; give one or the other."
            )
        opening_from(options)  # RigError or RobotError where a file cannot be used
        # Workers of a cluster run in folders of their own.
        rig, urdf = (path and path.absolute() for path in (options.rig, options.urdf))
        meshes = tuple(str(folder.absolute()) for folder in options.meshes)
        return replace(
            plan,
            recordings=tuple(
                Recorded(
                    path.absolute(), options.fixed_frame, options.truth_frame, rig, urdf, meshes
                )
                for path in recording_paths(options.recordings)
            ),
        )
    for name in ("fixed_frame", "truth_frame", "urdf", "meshes"):
        if getattr(options, name):
            raise InputError(
                f"--{name.replace('_', '-')} says how recordings are opened, and there are none "
                "without --recordings."
            )
    wanted = {name: getattr(options, name) for name in given}
    check_simulation(wanted.get("speed", ()), wanted.get("trial", ()), wanted.get("seed", 0))
    return replace(
        plan,
        scenarios=scenario_names(wanted.get("scenario", [ALL])),
        speeds=_once(wanted["speed"]) if "speed" in wanted else None,
        trials=_once(wanted.get("trial", TRIALS)),
        seed=wanted.get("seed", 0),
        noise=wanted.get("noise", "paper"),
        imperfections=tuple(n for n in IMPERFECTIONS if n in wanted.get("imperfections", ())),
        ablation=wanted.get("ablation", False),
        rig=_checked_rig(options.rig),
    )


def _checked_rig(path: Path | None) -> Path | None:
    """Absolute path of a valid rig; workers of a cluster run in other folders."""
    if path is not None:
        load_rig(path)  # RigError where it cannot be used
    return path and path.absolute()


def _once(values: Iterable[_T]) -> tuple[_T, ...]:
    return tuple(dict.fromkeys(values))


def _command() -> str:
    return shlex.join(["tofscope", *sys.argv[1:]])
