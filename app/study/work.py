"""One unit of a study's work: a recording, evaluated with every set of parameters it is for."""

import logging
import math
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import asdict, dataclass, field, replace
from pathlib import Path
from time import thread_time

from threadpoolctl import threadpool_limits

from app.analysis.evaluation import Evaluation, EvaluationCase, evaluate_all
from app.analysis.notes import notes
from app.errors import UserError
from app.study.diagnosis import diagnose_missing_flow, diagnose_wrong_alignment
from app.study.software import software_digest
from estimator import Metrics, Parameters
from recordings import Recording, open_recording
from recordings.simulation import NOISE_MODELS, SCENARIOS, write_simulation
from robot_assets import load_rig, load_robot

_LOG = logging.getLogger(__name__)
_LARGE = 0.5
"""Share of the speed above which the error of what moves is looked into."""
SWEPT_SCENARIO = "towards"
"""In which n is varied (paper, section III-B)."""


@dataclass(frozen=True)
class Simulated:
    """A recording that the study simulates; names are those of `recordings.simulation`.

    Attributes:
        scenario: what moves.
        speed: m/s.
        trial: from 1.
        seed: of the random numbers.
        noise: name of the noise model.
        imperfections: names, in the registry's order.
        rig: file of the rig that it is simulated with, None for the paper's.
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
        """As in names of files."""
        return f"{self.scenario}_{self.speed:g}_{self.trial}"


@dataclass(frozen=True)
class Recorded:
    """A recording that is there, and how it is opened (see `tofscope evaluate --help`)."""

    path: Path
    fixed_frame: str | None = None
    truth_frame: str | None = None
    rig: Path | None = None
    urdf: Path | None = None

    @property
    def name(self) -> str:
        """As in names of files."""
        return self.path.stem


Source = Simulated | Recorded


@dataclass(frozen=True)
class Work:
    """A recording and what it is evaluated with.

    Attributes:
        source: the recording.
        cases: for every recording.
        sweep: parameters that are tried where the recording shows the swept scenario.
        method_files: FILE.py:NAME of methods that are not registered by themselves.
    """

    source: Source
    cases: tuple[EvaluationCase, ...]
    sweep: tuple[Parameters, ...] = ()
    method_files: tuple[str, ...] = ()

    def wanted(self, scenario: str | None) -> tuple[EvaluationCase, ...]:
        """What a recording of a scenario is evaluated with, each set of parameters once."""
        asked = {case.parameters for case in self.cases}
        sweep = self.sweep if scenario == SWEPT_SCENARIO else ()
        return (*self.cases, *(EvaluationCase(p, resting=False) for p in sweep if p not in asked))


@dataclass(frozen=True)
class Result:
    """What came of one set of parameters.

    Attributes:
        case: that is answered.
        metrics: {field of `Metrics`: its value, None where undefined}; None without truth.
        seconds: of one core, that it took.
        why: in a sentence, where no point got a flow what became of the moving ones, and where
            flow of moving points is far off what went wrong.
    """

    case: EvaluationCase
    metrics: dict[str, float | None] | None
    seconds: float
    diagnosis: str | None = None


@dataclass(frozen=True)
class Outcome:
    """What came of a unit of work.

    Attributes:
        source: the recording.
        scenario: that it shows, None where it does not say.
        speed: m/s that was asked of the moving object, None where it does not say.
        trial: its number, None where it does not say.
        noise: name of the noise model, None where it was not simulated.
        frames: in the recording.
        seconds: of one core, that making or opening it took.
        results: one for each case.
        warnings: sentences about the recording.
        failure: why there are no results, in a sentence.
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
    """Do a unit of work, here and now.

    Args:
        work: the unit.
        software: `software_digest` of whoever cases: a cluster may have another version.
        scratch: folder for the simulated file, the system's own where None.
    """
    if software != software_digest(work.method_files):
        return Outcome(
            work.source,
            failure=f"{work.source.name}: the worker has another version of Tofscope or of a "
            "package that it computes with; give all workers the same.",
        )
    try:
        # Cores are shared out by recordings; threads within would only fight for them.
        with threadpool_limits(1), _opened(work.source, scratch) as (recording, seconds):
            return _evaluated(work, recording, seconds)
    except UserError as error:
        return Outcome(work.source, failure=str(error))
    except Exception as error:
        _LOG.exception("Unexpected error in %s.", work.source.name)
        # One recording does not cost the others theirs.
        return Outcome(work.source, failure=f"{work.source.name}: {type(error).__name__}: {error}")


@contextmanager
def _opened(source: Source, scratch: Path | None) -> Iterator[tuple[Recording, float]]:
    """The recording, and the seconds that it took to make or open it."""
    begin = thread_time()
    if isinstance(source, Recorded):
        with open_recording(
            source.path,
            source.fixed_frame,
            source.truth_frame,
            load_rig(source.rig) if source.rig else None,
            load_robot(source.urdf) if source.urdf else None,
        ) as recording:
            yield recording, thread_time() - begin
        return
    with tempfile.TemporaryDirectory(prefix="tofscope-study-", dir=scratch) as folder:
        path = Path(folder) / f"{source.name}.mcap"
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
    # After the evaluation: some warnings come up only when frames are read.
    return replace(outcome, results=results, warnings=tuple(notes(recording)))


def _result(recording: Recording, case: EvaluationCase, evaluation: Evaluation) -> Result:
    metrics = evaluation.metrics
    if metrics is None:
        return Result(case, None, evaluation.seconds)
    begin = thread_time()
    values = {k: None if math.isnan(v) else v for k, v in asdict(metrics).items()}
    why = None
    if not metrics.points_with_flow:
        why = diagnose_missing_flow(recording, case.parameters)
    elif case.resting and _is_far_off(metrics, recording):
        why = diagnose_wrong_alignment(recording, case.parameters)
    return Result(case, values, evaluation.seconds + thread_time() - begin, why)


def _is_far_off(metrics: Metrics, recording: Recording) -> bool:
    """Whether errors are large though most of the flow is where something moves."""
    made = recording.provenance
    return (
        made is not None
        and made.speed is not None
        and metrics.precision > 0.5
        and metrics.velocity_error > _LARGE * made.speed
    )
