"""Unit of a study's work: one recording, evaluated with several sets of parameters."""

import logging
import math
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import asdict, dataclass, field, replace
from pathlib import Path
from time import thread_time

from app.analysis.evaluation import Evaluation, EvaluationCase, evaluate_all
from app.analysis.notes import notes
from app.errors import UserError
from app.output.scratch import scratch_folder
from app.study.diagnosis import diagnose_missing_flow, diagnose_wrong_alignment
from app.study.software import OTHER_VERSION, software_digest
from estimator import Metrics, Parameters
from recordings import Recording, open_recording
from recordings.simulation import NOISE_MODELS, SCENARIOS, write_simulation
from robot_assets import load_rig, load_robot

_LOG = logging.getLogger(__name__)
_LARGE = 0.5
"""Velocity error, as a share of the true speed, above which it is diagnosed."""
SWEPT_SCENARIO = "towards"
"""Scenario of the sweep of n (paper, section III-B)."""


@dataclass(frozen=True)
class Simulated:
    """A recording to simulate; names are those of `recordings.simulation`.

    Attributes:
        scenario: its name.
        speed: m/s.
        trial: from 1.
        seed: of the random numbers.
        noise: name of the noise model.
        imperfections: names, in the registry's order.
        rig: file of the rig, None for the paper's.
    """

    scenario: str
    speed: float
    trial: int
    seed: int = 0
    noise: str = "paper"
    imperfections: tuple[str, ...] = ()
    rig: Path | None = None

    @property
    def name(self) -> str:
        """Name of the recording in file names."""
        return f"{self.scenario}_{self.speed:g}_{self.trial}"


@dataclass(frozen=True)
class Recorded:
    """An existing recording, with options for opening it (see `tofscope evaluate --help`)."""

    path: Path
    fixed_frame: str | None = None
    truth_frame: str | None = None
    rig: Path | None = None
    urdf: Path | None = None
    mesh_folders: tuple[str, ...] = ()

    @property
    def name(self) -> str:
        """Name of the recording in file names."""
        return self.path.stem


Source = Simulated | Recorded


@dataclass(frozen=True)
class Work:
    """A recording and the cases to evaluate it with.

    Attributes:
        source: the recording.
        cases: for any scenario.
        sweep: further parameters if the recording is of the swept scenario.
        method_files: FILE.py:NAME of the methods that come from files.
    """

    source: Source
    cases: tuple[EvaluationCase, ...]
    sweep: tuple[Parameters, ...] = ()
    method_files: tuple[str, ...] = ()

    def wanted(self, scenario: str | None) -> tuple[EvaluationCase, ...]:
        """Cases for a recording of this scenario, without duplicates."""
        known = {case.parameters for case in self.cases}
        sweep = self.sweep if scenario == SWEPT_SCENARIO else ()
        return (*self.cases, *(EvaluationCase(p, resting=False) for p in sweep if p not in known))


@dataclass(frozen=True)
class Result:
    """Result of one case.

    Attributes:
        case: that was evaluated.
        metrics: {field of `Metrics`: its value, None where undefined}; None without truth.
        seconds: CPU time of one core.
        diagnosis: a sentence on why no point got a flow, or on errors that are large; else None.
    """

    case: EvaluationCase
    metrics: dict[str, float | None] | None
    seconds: float
    diagnosis: str | None = None


@dataclass(frozen=True)
class Outcome:
    """Outcome of a unit of work.

    Attributes:
        source: the recording.
        scenario: of the recording, None where unknown.
        speed: nominal speed of the moving object, m/s, None where unknown.
        trial: its number, None where unknown.
        noise: name of the noise model, None unless simulated.
        frames: number of frames.
        seconds: CPU time of one core for simulating or opening it.
        results: one per case.
        warnings: sentences about the recording.
        failure: a sentence on why there are no results, None for success.
    """

    source: Source
    scenario: str | None = None
    speed: float | None = None
    trial: int | None = None
    noise: str | None = None
    frames: int = 0
    seconds: float = 0.0
    results: tuple[Result, ...] = ()
    warnings: tuple[str, ...] = field(default=())
    failure: str | None = None


def run_work(work: Work, software: str, scratch: Path | None = None) -> Outcome:
    """Simulate or open a recording and evaluate it, in this process.

    Args:
        work: the unit.
        software: `software_digest` of the caller; a cluster's worker may have another version.
        scratch: folder for the simulated file, None for the system's.
    """
    from threadpoolctl import threadpool_limits

    if software != software_digest(work.method_files):
        return Outcome(work.source, failure=f"{work.source.name}: {OTHER_VERSION}.")
    try:
        # Cores are divided by recordings; further threads would compete for them.
        with threadpool_limits(1), _opened(work.source, scratch) as (recording, seconds):
            return _evaluated(work, recording, seconds)
    except UserError as error:
        return Outcome(work.source, failure=str(error))
    except Exception as error:
        _LOG.exception("Unexpected error in %s.", work.source.name)
        # A failure must not end the other recordings.
        return Outcome(work.source, failure=f"{work.source.name}: {type(error).__name__}: {error}")


@contextmanager
def _opened(source: Source, scratch: Path | None) -> Iterator[tuple[Recording, float]]:
    """Context of the open recording and the CPU seconds for simulating or opening it."""
    begin = thread_time()
    if isinstance(source, Recorded):
        with open_recording(
            source.path,
            source.fixed_frame,
            source.truth_frame,
            load_rig(source.rig) if source.rig else None,
            load_robot(source.urdf, source.mesh_folders) if source.urdf else None,
            source.mesh_folders,
        ) as recording:
            yield recording, thread_time() - begin
        return
    with scratch_folder(scratch) as folder:
        path = folder / f"{source.name}.mcap"
        write_simulation(
            path,
            SCENARIOS[source.scenario],
            speed=source.speed,
            trial=source.trial,
            seed=source.seed,
            noise=NOISE_MODELS[source.noise],
            imperfections=source.imperfections,
            robot=load_robot(),
            rig=load_rig(source.rig),
        )
        with open_recording(path) as recording:
            yield recording, thread_time() - begin


def _evaluated(work: Work, recording: Recording, seconds: float) -> Outcome:
    outcome = Outcome(work.source, frames=len(recording), seconds=seconds)
    if made := recording.provenance:
        outcome = replace(
            outcome,
            scenario=made.scenario,
            speed=made.speed,
            trial=made.trial,
            noise=made.noise.partition(":")[0],
        )
    cases = work.wanted(outcome.scenario)
    evaluations = evaluate_all(recording, cases)
    results = tuple(_result(recording, *each) for each in zip(cases, evaluations, strict=True))
    # After the evaluation, since some warnings arise when frames are read.
    return replace(outcome, results=results, warnings=tuple(notes(recording)))


def _result(recording: Recording, case: EvaluationCase, evaluation: Evaluation) -> Result:
    metrics = evaluation.metrics
    if metrics is None:
        return Result(case, None, evaluation.seconds)
    begin = thread_time()
    values = {k: None if math.isnan(v) else v for k, v in asdict(metrics).items()}
    diagnosis = None
    if not metrics.points_with_flow:
        diagnosis = diagnose_missing_flow(recording, case.parameters)
    elif case.resting and _is_far_off(metrics, recording):
        diagnosis = diagnose_wrong_alignment(recording, case.parameters)
    return Result(case, values, evaluation.seconds + thread_time() - begin, diagnosis)


def _is_far_off(metrics: Metrics, recording: Recording) -> bool:
    """Whether errors are large although most of the flow belongs to moving points."""
    made = recording.provenance
    return (
        made is not None
        and made.speed is not None
        and metrics.precision > 0.5
        and metrics.velocity_error > _LARGE * made.speed
    )
