"""Chromium's DevTools protocol over a pipe, whose end ends the browser, too."""

import itertools
import json
import os
import select
import time
from types import TracebackType
from typing import Any


class DevToolsError(Exception):
    """The browser has ended, does not answer, or refuses; the message is the reason."""


class DevTools:
    """Connection to a browser started with --remote-debugging-pipe; use it in a `with` statement.

    Args:
        output: descriptor of the pipe to the browser.
        entry: descriptor of the pipe from the browser.
    """

    def __init__(self, output: int, entry: int) -> None:
        self._output = output
        self._entry = entry
        self._received = b""
        self._numbers = itertools.count(1)

    def __enter__(self) -> "DevTools":
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        traceback: TracebackType | None,
    ) -> None:
        os.close(self._output)
        os.close(self._entry)

    def ask(
        self, method: str, end: float, session: str | None = None, **given: object
    ) -> dict[str, Any]:
        """Call a method and return its result.

        Args:
            method: of the protocol.
            end: time of the monotonic clock until which there must be an answer.
            session: of the page that is asked, None for the browser.
            **given: its arguments.

        Raises:
            DevToolsError: there is no answer, or it is an error.
        """
        number = next(self._numbers)
        message = {"id": number, "method": method, "params": given}
        if session is not None:
            message["sessionId"] = session
        try:
            os.write(self._output, json.dumps(message).encode() + b"\0")
        except BrokenPipeError as error:
            raise DevToolsError("it ended at once") from error
        while True:
            answer = json.loads(self._next(end))
            # Everything else is an event.
            if answer.get("id") == number:
                if "error" in answer:
                    raise DevToolsError(f"{method}: {answer['error'].get('message')}")
                return answer["result"]

    def _next(self, end: float) -> bytes:
        """The next message."""
        while b"\0" not in self._received:
            ready, _, _ = select.select([self._entry], [], [], max(0.0, end - time.monotonic()))
            if not ready:
                raise DevToolsError("it does not answer")
            more = os.read(self._entry, 65536)
            if not more:
                raise DevToolsError("it ended at once")
            self._received += more
        message, _, self._received = self._received.partition(b"\0")
        return message
