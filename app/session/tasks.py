"""Background tasks of a session, such as exports that take minutes."""

import logging
import threading
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass

from app.errors import UserError
from app.session.outbox import Message, Notice

_LOG = logging.getLogger(__name__)
_REPORT_INTERVAL = 0.3  # minimum seconds between two progress events

Report = Callable[[str], None]
Job = Callable[[Report], Sequence[Message]]
"""Work of a task. Its argument `report(text)` raises `TaskEndedError` when the task must end."""


class TaskEndedError(Exception):
    """The task must end, since its client has disconnected."""


@dataclass(frozen=True)
class TaskState:
    """A running task.

    Attributes:
        title: unique among running tasks.
        text: its progress.
    """

    title: str
    text: str


@dataclass(frozen=True)
class TaskEvent:
    """Progress or end of a task, posted by its thread.

    Attributes:
        title: of the task.
        text: its progress, None once it has ended.
        messages: its results.
    """

    title: str
    text: str | None
    messages: tuple[Message, ...] = ()


class Tasks:
    """Jobs, each in its own thread; used by the session's thread alone.

    Args:
        post: called with events by the tasks' threads; the session's thread must pass them to
            `receive`.
    """

    def __init__(self, post: Callable[[TaskEvent], None]) -> None:
        self._post = post
        self._running: dict[str, TaskState] = {}
        self._ended = threading.Event()

    @property
    def states(self) -> tuple[TaskState, ...]:
        """All running tasks."""
        return tuple(self._running.values())

    def running(self, title: str) -> bool:
        """Whether a task of this title is running."""
        return title in self._running

    def start(self, title: str, text: str, job: Job) -> None:
        """Start a task.

        Args:
            title: unlike that of any running task.
            text: initial progress.
            job: its work; an error in it becomes a notice.
        """
        self._running[title] = TaskState(title, text)
        # Not a daemon: it must not be cut off inside of Open3D when the program ends.
        threading.Thread(target=self._run, args=(title, job), name=title.lower()).start()

    def receive(self, event: TaskEvent) -> tuple[Message, ...]:
        """Update the state from an event, and return the event's results."""
        if event.text is None:
            del self._running[event.title]
        else:
            self._running[event.title] = TaskState(event.title, event.text)
        return event.messages

    def end(self) -> None:
        """End all tasks, each at its next report."""
        self._ended.set()

    def _run(self, title: str, job: Job) -> None:
        reported = time.monotonic()

        def report(text: str) -> None:
            nonlocal reported
            if self._ended.is_set():
                raise TaskEndedError
            if time.monotonic() > reported + _REPORT_INTERVAL:
                reported = time.monotonic()
                self._post(TaskEvent(title, text))

        try:
            messages = tuple(job(report))
        except TaskEndedError:
            messages = ()
        except UserError as error:
            messages = (_failure(title, str(error)),)
        except Exception as error:
            _LOG.exception("An unexpected error in the task %s.", title)
            sentence = f"It could not be made ({type(error).__name__}: {error})."
            messages = (_failure(title, sentence),)
        self._post(TaskEvent(title, None, messages))


def _failure(title: str, sentence: str) -> Notice:
    return Notice(title, sentence, "red", seconds=10.0)
