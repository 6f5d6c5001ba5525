"""Queue of a session's commands: callbacks post, one thread takes."""

import threading

from app.session.command import Command


class CommandQueue:
    """Thread-safe queue of pending commands, at most one of each kind.

    However many commands are posted, those of one kind are merged, so that nothing piles up.
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
            timeout: seconds to wait for one at most; None waits as long as it takes.

        Returns:
            The commands, none after the timeout, or None where the queue is closed.
        """
        with self._changed:
            self._changed.wait_for(lambda: self._pending or self._closed, timeout)
            if self._closed:
                return None
            commands = list(self._pending.values())
            self._pending.clear()
            return commands

    def close(self) -> None:
        """End every wait, now and later."""
        with self._changed:
            self._closed = True
            self._changed.notify_all()
