"""Queue of a session's commands, from callbacks to the session's thread."""

import threading

from app.session.command import Command


class CommandQueue:
    """Thread-safe queue of pending commands, at most one of each kind.

    Commands of one kind are merged, so that the queue stays short however many are posted.
    """

    def __init__(self) -> None:
        self._changed = threading.Condition()
        self._pending: dict[type[Command], Command] = {}
        self._closed = False

    def post(self, command: Command) -> None:
        """Add a command; a pending one of its kind is merged into it."""
        kind = type(command)
        with self._changed:
            earlier = self._pending.pop(kind, None)
            self._pending[kind] = command if earlier is None else command.merged_with(earlier)
            self._changed.notify()

    def has(self, kind: type[Command]) -> bool:
        """Whether a command of this kind is pending."""
        with self._changed:
            return kind in self._pending

    def take(self, timeout: float | None = None) -> list[Command] | None:
        """Take all commands, in the order of their last post.

        Args:
            timeout: maximum wait in seconds, None for no limit.

        Returns:
            The commands, empty after the timeout, or None once the queue is closed.
        """
        with self._changed:
            self._changed.wait_for(lambda: self._pending or self._closed, timeout)
            if self._closed:
                return None
            commands = list(self._pending.values())
            self._pending.clear()
            return commands

    def close(self) -> None:
        """Close the queue, and end all waits."""
        with self._changed:
            self._closed = True
            self._changed.notify_all()
