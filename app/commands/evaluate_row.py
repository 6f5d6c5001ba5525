"""A recording's row in the table of `tofscope evaluate`, in whatever process."""

import logging
import math
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

from app.analysis.evaluation import evaluate
from app.analysis.notes import NO_TRUTH, no_pair_note, notes, truth_frame_note
from app.commands.flags.recording_flags import Opening
from app.errors import UserError
from app.study.software import OTHER_VERSION, software_digest
from estimator import METRIC_INFO, Metrics, Parameters

_LOG = logging.getLogger(__name__)


@dataclass(frozen=True)
class Asked:
    """How recordings are evaluated.

    Attributes:
        opening: how they are opened.
        parameters: of the estimates.
        method_files: FILE.py:NAME of the method that comes from a file, if it does.
        software: `software_digest` of the command; a cluster's worker may have another version.
    """

    opening: Opening
    parameters: Parameters
    method_files: tuple[str, ...]
    software: str


@dataclass(frozen=True)
class Row:
    """A row of the table.

    Attributes:
        values: {column of the JSON: value, None where undefined}.
        warnings: sentences about the recording.
    """

    values: dict[str, Any]
    warnings: tuple[str, ...] = ()


def row_without_errors(path: Path, warning: str) -> Row:
    """The row of a recording that was not evaluated."""
    return Row(_empty(path), (warning,))


def row_of(path: Path, asked: Asked) -> Row:
    """Evaluate a recording; whatever goes wrong is a warning, and does not end the others."""
    from threadpoolctl import threadpool_limits

    if asked.software != software_digest(asked.method_files):
        return row_without_errors(path, f"{path}: {OTHER_VERSION}.")
    values = _empty(path)
    try:
        # Cores are divided by recordings, and sums are the same for any number of them.
        with threadpool_limits(1):
            warnings = _evaluate(path, asked, values)
    except UserError as error:
        warnings = [str(error)]
    except Exception as error:
        _LOG.exception("Unexpected error in %s.", path)
        warnings = [f"{path}: {type(error).__name__}: {error}."]
    return Row(values, tuple(warnings))


def _empty(path: Path) -> dict[str, Any]:
    row: dict[str, Any] = {"path": str(path), "scenario": None, "speed": None, "trial": None}
    return row | dict.fromkeys(METRIC_INFO)


def _evaluate(path: Path, asked: Asked, values: dict[str, Any]) -> list[str]:
    """Fill in a row as far as the recording can be read, and return its warnings."""
    with asked.opening.open(path) as recording:
        if source := recording.provenance:
            values |= {"scenario": source.scenario, "speed": source.speed, "trial": source.trial}
        metrics = evaluate(recording, asked.parameters)
        # After the evaluation: some things are found out only when frames are read.
        warnings = [f"{path}: {sentence}" for sentence in notes(recording)]
    if metrics is None:
        return [*warnings, f"{path} {NO_TRUTH}."]
    if metrics.pairs == 0:
        known = "" if math.isnan(metrics.false_flow) else " Only the false flow is known."
        warnings.append(f"{path} has {no_pair_note(asked.parameters.n)}.{known}")
    if asked.opening.truth_frame is not None:
        warnings.append(f"{path}: {truth_frame_note(asked.opening.truth_frame)}.")
    values |= _as_json(metrics)
    return warnings


def _as_json(metrics: Metrics) -> dict[str, Any]:
    return {k: None if math.isnan(v) else v for k, v in asdict(metrics).items()}
