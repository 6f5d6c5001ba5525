"""Trial of a hostile recording: everything that the app and the commands read of it."""

import contextlib
import io
import json
import logging
import signal
import time
import traceback
import warnings
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from itertools import islice
from pathlib import Path

from app.analysis import flows
from app.analysis.notes import notes
from app.commands import info
from app.errors import UserError
from estimator import Parameters
from recordings import Recording, open_recording
from recordings.info import file_info
from tests.fuzz.limits import HANGING_SECONDS, MEMORY_BYTES
from tests.fuzz.memory import forget_peak, peak_bytes

_MOST_SAID = 20_000  # characters


@dataclass(frozen=True)
class Outcome:
    """Outcome of a trial.

    Attributes:
        refusal: sentence that the file was refused with, "" where it was opened.
        told: sentences about it where it was opened.
        faults: what must not happen, one line each.
        seconds: of CPU time.
        memory: that the process took more, bytes.
    """

    refusal: str
    told: tuple[str, ...]
    faults: tuple[str, ...]
    seconds: float
    memory: int


def tried(path: Path) -> Outcome:
    """Open a file, read what there is to read of it, and tell about it.

    It is interrupted where it hangs; whether it is quick is for `make fuzz` to say, since that
    depends on the machine.
    """
    faults: list[str] = []
    sentences: list[str] = []
    forget_peak()
    before = peak_bytes()
    began = time.process_time()
    refusal = ""
    with _told(faults), _interrupted(faults):
        refusal = _refused(lambda: _opened(path, sentences), faults)
        _refused(lambda: _informed(path), faults)
    seconds = time.process_time() - began
    if (taken := peak_bytes() - before) > MEMORY_BYTES:
        faults.append(f"it took {taken / 1e6:.0f} MB")
    return Outcome(refusal, tuple(sentences), tuple(faults), seconds, taken)


def _opened(path: Path, told: list[str]) -> None:
    with open_recording(path) as recording:
        last = len(recording) - 1
        for k in sorted({0, last // 2, last}):
            _frame(recording, k)
        recording.pair_truth(0, last) if last else None
        if recording.robot is not None:
            _ = recording.robot.visual_meshes
        for _ in islice(flows(recording, Parameters(n=2)), 2):
            pass
        told += notes(recording)
        assert sum(map(len, told)) < _MOST_SAID, f"{len(told)} sentences about one file"
        for sentence in told:
            _check_sentence(sentence)
        summary = info._described(recording)
        json.dumps(summary)
        info._lines(summary)


def _frame(recording: Recording, k: int) -> None:
    recording.cloud(k)
    recording.T_fixed_sensor(k)
    recording.link_poses(k)
    recording.joint_positions(k)
    recording.truth(k)
    recording.point_truth(k)


def _informed(path: Path) -> None:
    for topic in file_info(path).topics:
        info._cells(topic)


def _refused(action: Callable[[], None], faults: list[str]) -> str:
    """The sentence that an action is refused with, "" where it is not."""
    try:
        action()
    except UserError as error:
        try:
            _check_sentence(str(error))
        except AssertionError as wrong:
            faults.append(str(wrong))
        return str(error)
    except AssertionError as wrong:
        faults.append(str(wrong))
    except Exception as error:
        place = traceback.extract_tb(error.__traceback__)[-1]
        faults.append(f"{type(error).__name__} at {Path(place.filename).name}:{place.lineno}")
    return ""


def _check_sentence(text: str) -> None:
    assert "\n" not in text, f"more than a line: {text[:100]!r}"
    assert text.endswith("."), f"no sentence: {text[-100:]!r}"
    assert "Traceback" not in text, f"a traceback: {text[:100]!r}"


@contextlib.contextmanager
def _interrupted(faults: list[str]) -> Iterator[None]:
    """Context that ends after too many seconds of CPU, which is a fault."""
    before = signal.signal(signal.SIGPROF, _interrupt)
    signal.setitimer(signal.ITIMER_PROF, HANGING_SECONDS)
    try:
        yield
    except _Hangs:
        faults.append(f"it was interrupted after {HANGING_SECONDS:g} s of CPU")
    finally:
        signal.setitimer(signal.ITIMER_PROF, 0.0)
        signal.signal(signal.SIGPROF, before)


class _Hangs(BaseException):
    """Raised where a trial is interrupted; what catches every Exception does not catch it."""


def _interrupt(*_: object) -> None:
    raise _Hangs


@contextlib.contextmanager
def _told(faults: list[str]) -> Iterator[None]:
    """Context in which warnings, log records and prints are faults."""
    out, said = io.StringIO(), io.StringIO()
    handler = logging.StreamHandler(said)
    handler.setLevel(logging.WARNING)
    last, logging.lastResort = logging.lastResort, handler
    try:
        with (
            warnings.catch_warnings(record=True) as raised,
            contextlib.redirect_stdout(out),
            contextlib.redirect_stderr(said),
        ):
            warnings.simplefilter("always", RuntimeWarning)
            warnings.simplefilter("always", UserWarning)
            yield
    finally:
        logging.lastResort = last
    faults += [f"warning: {warning.message}" for warning in raised]
    faults += [f"printed: {line}" for line in (out.getvalue() + said.getvalue()).splitlines()]
