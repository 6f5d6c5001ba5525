"""What is finished and what is left: a live line on a terminal, plain lines elsewhere."""

import shutil
import sys
from collections import deque
from collections.abc import Sequence
from time import monotonic

from app.study.work import Simulated, Source, Work

_SIMULATING = 2.0
"""Estimates of a method over a recording that take as long as simulating it."""


class Progress:
    """Says how far a study is, on standard output.

    Args:
        works: what is left to do.
        total: units of work in all, those that are known from before included.
        at_once: units that are done at the same time.

    Attributes:
        finished: units of work, those from before included.
    """

    def __init__(self, works: Sequence[Work], total: int, at_once: int = 1) -> None:
        self._efforts = {work.source: _effort(work) for work in works}
        self._total = total
        self.finished = total - len(works)
        self._live = sys.stdout.isatty()
        begin = monotonic()
        self._begun = deque([begin] * min(at_once, len(works)))
        """When what is under way began, the earliest first."""
        self._done = self._spent = 0.0

    def advance(self, source: Source) -> None:
        """A unit of work is finished, and where there is more, another one begins."""
        now = monotonic()
        self.finished += 1
        self._done += self._efforts.pop(source)
        # Which of those under way this was does not matter: together they began then.
        self._spent += now - self._begun.popleft()
        if len(self._begun) < len(self._efforts):
            self._begun.append(now)
        line = f"{self.finished}/{self._total}  {source.name}  {self._left(now)}"
        if self._live:
            width = shutil.get_terminal_size().columns - 1
            print(f"\r\x1b[K{line[:width]}", end="", flush=True)
        else:
            print(line, flush=True)

    def close(self) -> None:
        """Clear the live line away."""
        if self._live:
            print("\r\x1b[K", end="", flush=True)

    def _left(self, now: float) -> str:
        if not self._efforts:
            return "all finished"
        work = sum(self._efforts.values()) * self._spent / self._done
        under_way = sum(now - begun for begun in self._begun)
        seconds = max(work - under_way, 0.0) / len(self._begun)
        return f"{len(self._efforts)} left, about {duration(seconds)}"


def _effort(work: Work) -> float:
    """How long a unit takes, in estimates of a method over a recording."""
    if isinstance(work.source, Simulated):
        return len(work.wanted(work.source.scenario)) + _SIMULATING
    return len(work.wanted(None))


def duration(seconds: float) -> str:
    """Seconds as people say them."""
    whole = round(seconds)
    return f"{whole} s" if whole < 100 else f"{whole // 60} min {whole % 60:02d} s"
