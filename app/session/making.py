"""Files that are made of the open recording in the background."""

from collections.abc import Callable, Sequence

from app.analysis.estimates import Estimates
from app.analysis.library import Opened
from app.errors import InputError
from app.session.outbox import Download, Message, Notice
from app.session.tasks import Report
from app.session.workbench import Workbench

_QUIET = 0.02  # seconds without foreground work before the next step
_PATIENCE = 0.5  # seconds after which it continues in any case
_READ = 10.0  # seconds that a notice of a file stays


class Making:
    """A file that is being made; used by its task's thread.

    Attributes:
        opened: the recording, open until the file is made, even if the session opens another.
        estimates: computes and caches flows.
    """

    def __init__(self, opened: Opened, estimates: Estimates, report: Report) -> None:
        self.opened, self.estimates = opened, estimates
        self._report = report

    def step(self, text: str) -> None:
        """Say how far it is, once what a person waits for in the page is done.

        Raises:
            TaskEndedError: the client has disconnected.
        """
        self.estimates.foreground.wait_until_quiet(_QUIET, _PATIENCE)
        self._report(text)


def start_making(
    workbench: Workbench, title: str, text: str, make: Callable[[Making], Sequence[Message]]
) -> None:
    """Start to make a file of the open recording.

    Args:
        workbench: with an open recording.
        title: what it is, such as "Video"; one of a title is made at a time.
        text: initial progress.
        make: makes it, and returns it with what is said of it.

    Raises:
        InputError: another one is being made.
        RecordingError: the recording cannot be opened once more.
    """
    if workbench.opened is None:
        return
    if workbench.tasks.running(title):
        raise InputError(f"Another {title.lower()} is being made already; wait until it is there.")
    library, estimates = workbench.library, workbench.estimates
    opened = library.open(workbench.opened.entry)

    def job(report: Report) -> Sequence[Message]:
        try:
            return make(Making(opened, estimates, report))
        finally:
            library.release(opened.entry)

    workbench.tasks.start(title, text, job)


def delivered(title: str, name: str, content: bytes, amount: str = "") -> Sequence[Message]:
    """A finished file, and the notice that it has arrived.

    Args:
        title: what it is.
        name: of the file.
        content: of the file.
        amount: how much is in it, by default its size.
    """
    amount = amount or f"{len(content) / 1e6:.1f} MB"
    sentence = f"{name}, {amount}, is in your downloads."
    return Download(name, content), Notice(title, sentence, "green", seconds=_READ)
