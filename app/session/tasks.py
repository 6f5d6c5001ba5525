"""Background tasks of a session, such as a file that takes minutes to make."""

import logging
import threading
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass

from app.errors import UserError
from app.session.outbox import Message, Notice

_LOG = logging.getLogger(__name__)
_TELL = 0.3  # seconds between two reports that are passed on

Report = Callable[[str], None]
Job = Callable[[Report], Sequence[Message]]
"""Work of a task: is given `report(text)`, which raises `TaskEndedError` once it is to end."""


class TaskEndedError(Exception):
    """The client that a task works for has gone."""


@dataclass(frozen=True)
class TaskState:
    """Task that is running.

    Attributes:
        title: one task of a title runs at a time.
        text: how far it is.
    """

    title: str
    text: str


@dataclass(frozen=True)
class TaskEvent:
    """News of a task, from its own thread.

    Attributes:
        title: of the task.
        text: how far it is, None where it has ended.
        messages: its results.
    """

    title: str
    text: str | None
    messages: tuple[Message, ...] = ()


class Tasks:
    """Jobs in threads of their own; used by the session's thread alone.

    Args:
        tell: takes the news of all tasks, from their threads; `receive` is to be called with them
            by the session's thread.
    """

    def __init__(self, tell: Callable[[TaskEvent], None]) -> None:
        self._tell = tell
        self._running: dict[str, TaskState] = {}
        self._ended = threading.Event()

    @property
    def states(self) -> tuple[TaskState, ...]:
        """All tasks that are running."""
        return tuple(self._running.values())

    def running(self, title: str) -> bool:
        """Whether a task of this title is running."""
        return title in self._running

    def start(self, title: str, text: str, job: Job) -> None:
        """Start a task.

        Args:
            title: that no running task has.
            text: to begin with.
            job: its work; what goes wrong in it becomes a notice.
        """
        self._running[title] = TaskState(title, text)
        # Not a daemon: it must not be cut off inside of Open3D when the program ends.
        threading.Thread(target=self._run, args=(title, job), name=title.lower()).start()

    def receive(self, event: TaskEvent) -> tuple[Message, ...]:
        """Take note of news, and hand out the results that came with them."""
        if event.text is None:
            del self._running[event.title]
        else:
            self._running[event.title] = TaskState(event.title, event.text)
        return event.messages

    def end(self) -> None:
        """End all tasks, each at its next report."""
        self._ended.set()

    def _run(self, title: str, job: Job) -> None:
        told = time.monotonic()

        def report(text: str) -> None:
            nonlocal told
            if self._ended.is_set():
                raise TaskEndedError
            if time.monotonic() > told + _TELL:
                told = time.monotonic()
                self._tell(TaskEvent(title, text))

        try:
            messages = tuple(job(report))
        except TaskEndedError:
            messages = ()
        except UserError as error:
            messages = (_failure(title, str(error)),)
        except Exception as error:
            _LOG.exception("An unexpected error in the task %s.", title)
            said = f"It could not be made ({type(error).__name__}: {error})."
            messages = (_failure(title, said),)
        self._tell(TaskEvent(title, None, messages))


def _failure(title: str, sentence: str) -> Notice:
    return Notice(title, sentence, "red", seconds=10.0)
