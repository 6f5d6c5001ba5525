"""Progress of a study: a bar at a terminal, plain lines elsewhere."""

from collections import deque
from collections.abc import Sequence
from time import monotonic

from app.study.work import Simulated, Source, Work
from app.terminal.bar import Bar
from app.terminal.output import terminal
from app.terminal.printable import printable

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
        console = terminal()
        self._bar = Bar(console, total) if console else None
        begin = monotonic()
        self._begun = deque([begin] * min(at_once, len(works)))
        """When what is under way began, the earliest first."""
        self._done = self._spent = 0.0
        if self._bar and works:
            self._bar.show(self.finished, "", f"{len(works)} left")

    def advance(self, source: Source) -> None:
        """A unit of work is finished, and where there is more, another one begins."""
        now = monotonic()
        self.finished += 1
        self._done += self._efforts.pop(source)
        # Which of those under way this was does not matter: together they began then.
        self._spent += now - self._begun.popleft()
        if len(self._begun) < len(self._efforts):
            self._begun.append(now)
        if self._bar:
            self._bar.show(self.finished, source.name, self._left(now))
        else:
            name = printable(source.name)
            print(f"{self.finished}/{self._total}  {name}  {self._left(now)}", flush=True)

    def close(self) -> None:
        """Clear the bar away."""
        if self._bar:
            self._bar.hide()

    def _left(self, now: float) -> str:
        if not self._efforts:
            return "all finished"
        work = sum(self._efforts.values()) * self._spent / self._done
        under_way = sum(now - begun for begun in self._begun)
        seconds = max(work - under_way, 0.0) / len(self._begun)
        return f"{len(self._efforts)} left, about {duration(seconds)}"


def _effort(work: Work) -> float:
    """Expected effort of a unit, in estimates of one method over a recording."""
    if isinstance(work.source, Simulated):
        return len(work.wanted(work.source.scenario)) + _SIMULATING
    return len(work.wanted(None))


def duration(seconds: float) -> str:
    """Seconds as people say them."""
    whole = round(seconds)
    return f"{whole} s" if whole < 100 else f"{whole // 60} min {whole % 60:02d} s"
