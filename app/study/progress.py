"""What is finished and what is left: a live line on a terminal, plain lines elsewhere."""

import shutil
import sys
from time import monotonic


class Progress:
    """Says how far a study is, on standard output.

    Args:
        total: units of work in all.
        finished: of them, known from before.

    Attributes:
        finished: units of work, those from before included.
    """

    def __init__(self, total: int, finished: int) -> None:
        self._total = total
        self._before = finished
        self.finished = finished
        self._begin = monotonic()
        self._live = sys.stdout.isatty()

    def advance(self, name: str) -> None:
        """A unit of work is finished."""
        self.finished += 1
        line = f"{self.finished}/{self._total}  {name}  {self._left()}"
        if self._live:
            width = shutil.get_terminal_size().columns - 1
            print(f"\r\x1b[K{line[:width]}", end="", flush=True)
        else:
            print(line, flush=True)

    def close(self) -> None:
        """Clear the live line away."""
        if self._live:
            print("\r\x1b[K", end="", flush=True)

    def _left(self) -> str:
        left = self._total - self.finished
        if not left:
            return "all finished"
        each = (monotonic() - self._begin) / (self.finished - self._before)
        return f"{left} left, about {duration(each * left)}"


def duration(seconds: float) -> str:
    """Seconds as people say them."""
    whole = round(seconds)
    return f"{whole} s" if whole < 100 else f"{whole // 60} min {whole % 60:02d} s"
