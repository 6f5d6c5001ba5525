"""Queue of a session's commands, from callbacks to the session's thread."""

import threading

from app.session.command import Background, Command


class CommandQueue:
    """Thread-safe queue of pending commands, in posting order.

    Consecutive commands of one kind are merged, so that the queue stays short while a slider is
    dragged. They are not merged across a command of another kind, which may depend on the order.
    Background commands may be merged across others, and others across them.
    """

    def __init__(self) -> None:
        self._changed = threading.Condition()
        self._pending: list[Command] = []
        self._closed = False

    def post(self, command: Command) -> None:
        """Add a command, or merge it with the last pending one if both are of one kind."""
        with self._changed:
            index = self._mergeable(command)
            if index is None:
                self._pending.append(command)
            else:
                self._pending[index] = command.merged_with(self._pending[index])
            self._changed.notify()

    def has(self, kind: type[Command]) -> bool:
        """Whether a command of this kind is pending."""
        with self._changed:
            return any(type(command) is kind for command in self._pending)

    def take(self, timeout: float | None = None) -> list[Command] | None:
        """Take all commands, in their order.

        Args:
            timeout: maximum wait in seconds, None for no limit.

        Returns:
            The commands, empty after the timeout, or None once the queue is closed.
        """
        with self._changed:
            self._changed.wait_for(lambda: self._pending or self._closed, timeout)
            if self._closed:
                return None
            commands, self._pending = self._pending, []
            return commands

    @property
    def closed(self) -> bool:
        """Whether the queue was closed."""
        with self._changed:
            return self._closed

    def close(self) -> None:
        """Close the queue, and end all waits."""
        with self._changed:
            self._closed = True
            self._changed.notify_all()

    def _mergeable(self, command: Command) -> int | None:
        """Index of the pending command to merge this one with, None if there is none."""
        for index in reversed(range(len(self._pending))):
            earlier = self._pending[index]
            if type(earlier) is type(command):
                return index
            if not isinstance(earlier, Background) and not isinstance(command, Background):
                return None
        return None
