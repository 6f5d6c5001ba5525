"""Progress of a study: a bar at a terminal, plain lines elsewhere."""

from collections import deque
from collections.abc import Sequence
from time import monotonic

from app.study.work import Simulated, Source, Work
from app.terminal.bar import Bar
from app.terminal.output import terminal
from robot_assets.printable import printable

_SIMULATING = 2.0
"""Time to simulate a recording, in units of the time to run one method on it."""


class Progress:
    """Progress of a study on standard output.

    Args:
        works: remaining units of work.
        total: number of all units, including those finished in earlier runs.
        at_once: number of units that run at the same time.

    Attributes:
        finished: number of finished units, including those of earlier runs.
    """

    def __init__(self, works: Sequence[Work], total: int, at_once: int = 1) -> None:
        self._efforts = {work.source: _effort(work) for work in works}
        self._total = total
        self.finished = total - len(works)
        console = terminal()
        self._bar = Bar(console, total) if console else None
        begin = monotonic()
        self._begun = deque([begin] * min(at_once, len(works)))
        """Start times of the running units, the earliest first."""
        self._done = self._spent = 0.0
        if self._bar and works:
            self._bar.show(self.finished, "", f"{len(works)} left")

    def advance(self, source: Source) -> None:
        """Count a finished unit; the next one, if any, starts now."""
        now = monotonic()
        self.finished += 1
        self._done += self._efforts.pop(source)
        # Any of the running units may have finished: only the sum of their start times counts.
        self._spent += now - self._begun.popleft()
        if len(self._begun) < len(self._efforts):
            self._begun.append(now)
        if self._bar:
            self._bar.show(self.finished, source.name, self._left(now))
        else:
            name = printable(source.name)
            print(f"{self.finished}/{self._total}  {name}  {self._left(now)}", flush=True)

    def close(self) -> None:
        """Clear the bar."""
        if self._bar:
            self._bar.hide()

    def _left(self, now: float) -> str:
        if not self._efforts:
            return "all finished"
        work = sum(self._efforts.values()) * self._spent / self._done
        running = sum(now - begun for begun in self._begun)
        seconds = max(work - running, 0.0) / len(self._begun)
        return f"{len(self._efforts)} left, about {duration(seconds)}"


def _effort(work: Work) -> float:
    """Expected effort of a unit, in estimates of one method over a recording."""
    if isinstance(work.source, Simulated):
        return len(work.wanted(work.source.scenario)) + _SIMULATING
    return len(work.wanted(None))


def duration(seconds: float) -> str:
    """Format a duration in seconds or minutes, such as "12 s" or "3 min 05 s"."""
    whole = round(seconds)
    return f"{whole} s" if whole < 100 else f"{whole // 60} min {whole % 60:02d} s"
