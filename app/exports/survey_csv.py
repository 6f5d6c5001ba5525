"""Surveys as CSV files."""

import csv
import io
from collections.abc import Mapping

import numpy as np

from app.analysis.quantities import QUANTITIES, Quantity, times
from app.analysis.survey import Survey
from app.exports.csv_heading import described
from app.output.text import csv_cell
from recordings import Recording

_COUNTS = "counts in the means [0 or 1]"


def to_csv(recording: Recording, surveys: Mapping[str, Survey]) -> str:
    """Write surveys as CSV: a comment line for each, a header with units, and a line per frame.

    Undefined values are left empty.

    Args:
        recording: of the surveys.
        surveys: {A or B: its survey}; with two, the names of the columns begin with A or B.
    """
    columns = {
        "stamp [s]": [f"{stamp:.9f}" for stamp in recording.stamps],
        "time [s]": _texts(times(recording), ".6f"),
    }
    text = io.StringIO()
    for side, survey in surveys.items():
        name = f"{side}: " if len(surveys) > 1 else ""
        text.write(f"# {_heading(recording, survey, name)}\n")
        columns |= {name + title: cells for title, cells in _columns(recording, survey).items()}
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(["frame", *columns])
    rows = zip(range(len(recording)), *columns.values(), strict=True)
    writer.writerows(map(csv_cell, row) for row in rows)
    return text.getvalue()


def _columns(recording: Recording, survey: Survey) -> dict[str, list[str]]:
    """{heading: cells} of all that a survey holds."""
    columns = {
        _heading_of(quantity): _texts(
            quantity.values(recording, survey), ".0f" if quantity.kind == "count" else ".6g"
        )
        for name, quantity in QUANTITIES.items()
        if name != "time"
    }
    if recording.has_truth:
        columns[_COUNTS] = [str(int(counts)) for counts in survey.counts]
    return columns


def _heading_of(quantity: Quantity) -> str:
    unit = {"°": "deg", "": "count" if quantity.kind == "count" else "1"}
    return f"{quantity.title} [{unit.get(quantity.unit, quantity.unit)}]"


def _heading(recording: Recording, survey: Survey, name: str) -> str:
    heading = f"{name}Tofscope; {described(recording, survey.parameters)}"
    if not survey.complete:
        heading += f"; {np.count_nonzero(survey.done)} of {len(survey)} frames computed"
    return heading


def _texts(values: np.ndarray, form: str) -> list[str]:
    return [format(value, form) if np.isfinite(value) else "" for value in values]
