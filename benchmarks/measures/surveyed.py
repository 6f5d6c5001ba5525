"""All that the page plots of a recording: read, estimated and judged; with other thresholds, too.

The naive way reads the recording with the same reader, and estimates one pair after the other.
"""

import statistics
import tempfile
import threading
import time
from collections.abc import Iterator
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import Any

from app.analysis.estimates import Estimates
from app.analysis.library import Entry, Opened
from app.analysis.survey import Survey
from app.analysis.surveys import Surveys
from benchmarks import naive
from benchmarks.inputs import windows_of, write_whole
from benchmarks.rows import Row, milliseconds
from estimator import Parameters, Window
from recordings import Recording, open_recording

_CHANGES = {"gamma": (0.3, 0.6, 0.9), "delta": (0.02, 0.05, 0.1), "n_min": (20, 40, 100)}
_TIMES = 3


def measure() -> Iterator[Row]:
    """A recording that was never read, then other values of each threshold."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "whole.mcap"
        write_whole(path)
        yield _from_the_file(path)
        with open_recording(path) as recording:
            surveys, opened = Surveys(Estimates()), _opened(path, recording)
            _survey(surveys, opened)
            _wait_until_idle(surveys)  # until the rounds are kept, too
            windows = windows_of(path)
            for name, values in _CHANGES.items():
                yield _changed(surveys, opened, windows, name, values)


def _from_the_file(path: Path) -> Row:
    def ours() -> None:
        surveys = Surveys(Estimates())
        with open_recording(path) as recording:
            _survey(surveys, _opened(path, recording))
            surveys.cancel("bench")
            _wait_until_idle(surveys)

    def theirs() -> None:
        for window in windows_of(path):
            naive.flow(window)

    both = [(milliseconds(ours), milliseconds(theirs)) for _ in range(_TIMES)]
    mine, other = (statistics.median(column) for column in zip(*both, strict=True))
    return Row("a recording read and surveyed, all cores", mine, naive=other)


def _changed(
    surveys: Surveys, opened: Opened, windows: list[Window], name: str, values: tuple[float, ...]
) -> Row:
    ours, theirs = [], []
    for value in values:
        change: dict[str, Any] = {name: value}
        parameters = replace(Parameters(), **change)
        request = partial(surveys.request, "bench", opened, parameters, lambda _: None)
        ours.append(milliseconds(request))
        assert request().complete
        theirs.append(
            milliseconds(lambda change=change: [naive.flow(w, **change) for w in windows])
        )
    what = f"{name}, all {len(windows)} pairs of a recording that was surveyed"
    return Row(what, statistics.median(ours), naive=statistics.median(theirs))


def _opened(path: Path, recording: Recording) -> Opened:
    return Opened(Entry(path.stem, path), recording, (str(path), 0, 0))


def _survey(surveys: Surveys, opened: Opened) -> None:
    complete = threading.Event()

    def notify(survey: Survey) -> None:
        if survey.complete:
            complete.set()

    surveys.request("bench", opened, Parameters(), notify)
    complete.wait()


def _wait_until_idle(surveys: Surveys) -> None:
    while not surveys.idle:
        time.sleep(0.001)
