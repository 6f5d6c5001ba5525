"""Where callbacks leave what a person wishes: one slot per kind of wish, the latest wins."""

import threading
from collections.abc import Hashable
from typing import TYPE_CHECKING, Protocol, Self

if TYPE_CHECKING:
    from app.session.workbench import Workbench


class Wish(Protocol):
    """Something that a person wants; its class is its kind."""

    def after(self, earlier: Self) -> Self:
        """The one wish that stands for an `earlier` one, not yet taken, and this one."""
        ...

    def fulfil(self, workbench: "Workbench") -> None:
        """Do what is wished, in the session's thread; may raise what a person is to be told."""
        ...


class Mailbox:
    """Wishes of one session between viser's threads, which post, and the worker, which takes.

    However many wishes are posted, no more than one of each kind waits, so nothing queues.
    """

    def __init__(self) -> None:
        self._changed = threading.Condition()
        self._waiting: dict[Hashable, Wish] = {}
        self._closed = False

    def post(self, wish: Wish) -> None:
        """Leave a wish; one of its kind that still waits is merged into it."""
        with self._changed:
            earlier = self._waiting.pop(type(wish), None)
            self._waiting[type(wish)] = wish if earlier is None else wish.after(earlier)
            self._changed.notify()

    def waits(self, kind: type) -> bool:
        """Whether a wish of this kind waits."""
        with self._changed:
            return kind in self._waiting

    def take(self, timeout: float | None = None) -> list[Wish] | None:
        """Take all wishes, in the order of their last post.

        Args:
            timeout: seconds to wait for one at most; None waits as long as it takes.

        Returns:
            The wishes, none after the timeout, or None where the mailbox is closed.
        """
        with self._changed:
            self._changed.wait_for(lambda: self._waiting or self._closed, timeout)
            if self._closed:
                return None
            wishes = list(self._waiting.values())
            self._waiting.clear()
            return wishes

    def close(self) -> None:
        """End every wait, now and later."""
        with self._changed:
            self._closed = True
            self._changed.notify_all()
