"""Surveys as CSV files."""

import csv
import io
import re

import numpy as np

from app.analysis.survey import Survey
from app.output.text import csv_cell, escaped
from estimator import METRIC_INFO, to_nested
from recordings import Recording


def to_csv(recording: Recording, survey: Survey) -> str:
    """Write a survey as CSV: a comment line, a header with units, and a line per frame.

    Undefined values are left empty.
    """
    stamps = recording.stamps
    columns = {
        "stamp [s]": [f"{stamp:.9f}" for stamp in stamps],
        "time [s]": _texts(stamps - stamps[0], ".6f"),
        "moving points [count]": _texts(survey.moving, ".0f"),
        "speed estimated [m/s]": _texts(survey.speed, ".6g"),
        "speed true [m/s]": _texts(survey.true_speed, ".6g"),
    } | {
        f"{METRIC_INFO[name].title} [{METRIC_INFO[name].unit or 1}]": _texts(values, ".6g")
        for name, values in survey.metrics.items()
    }
    text = io.StringIO()
    text.write(f"# {_heading(recording, survey)}\n")
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(["frame", *columns])
    rows = zip(range(len(survey)), *columns.values(), strict=True)
    writer.writerows(map(csv_cell, row) for row in rows)
    return text.getvalue()


def _heading(recording: Recording, survey: Survey) -> str:
    parameters = "; ".join(
        f"{name}={value}" for name, value in to_nested(survey.parameters).items()
    )
    origin = "simulated" if recording.simulated else "measured"
    # A line break would end the comment, and what separates cells would let one begin in the name.
    name = " ".join(re.split(r'[\s,;"]+', escaped(recording.path.name)))
    heading = f"Tofscope; recording {name}; {origin}; {parameters}"
    if not survey.complete:
        heading += f"; {np.count_nonzero(survey.done)} of {len(survey)} frames computed"
    return heading


def _texts(values: np.ndarray, form: str) -> list[str]:
    return [format(value, form) if np.isfinite(value) else "" for value in values]
