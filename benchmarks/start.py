"""Start of the command line and of the app: medians, beside another checkout where one is given.

Run it from the project's folder: `.venv/bin/python -m benchmarks.start`. With `--against FOLDER`,
another checkout of the project is measured in the same run, in turns with this one.
"""

import argparse
import statistics
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

from app.commands.running import SUBCOMMANDS
from benchmarks.serving import machine, serving, wait_until
from tests.app.wire_client import WireClient

_ROUNDS = 7
_ESTIMATED = ">Δt of the pair<"
"""Stands on the page once the first pair is estimated and drawn."""
_BROWSER = 1.0
"""Seconds from the address to the connection: a browser loads the page's code meanwhile."""
_HELP = "import sys; from app.command_line import main; sys.exit(main())"


def help_of(*command: str) -> Callable[[Path], float]:
    """Measurement of the seconds until a help is printed."""

    def measured(folder: Path) -> float:
        begin = time.perf_counter()
        arguments = [sys.executable, "-c", _HELP, *command, "--help"]
        subprocess.run(arguments, cwd=folder, stdout=subprocess.DEVNULL, check=True)
        return time.perf_counter() - begin

    return measured


def view(folder: Path) -> tuple[float, float]:
    """Seconds until `tofscope view` prints its address, and until the first pair is drawn."""
    drawn: list[float] = []

    def listen(now: float, message: dict[str, Any]) -> None:
        if _ESTIMATED in str(message):
            drawn.append(now)

    begin = time.perf_counter()
    with serving(folder=folder) as served:
        printed = time.perf_counter() - begin
        time.sleep(_BROWSER)
        client = WireClient(served.address, listen)
        wait_until(lambda: drawn, 60)
        client.close()
    return printed, drawn[0] - begin


def main() -> None:
    """Print a line for each thing that is started."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--against", type=Path, metavar="FOLDER", help="another checkout")
    against = parser.parse_args().against
    folders = [Path.cwd(), *([against] if against else [])]
    print(machine())
    for command in ((), *((name,) for name in SUBCOMMANDS)):
        measured = help_of(*command)
        times = _in_turns(folders, measured)
        print(_line(" ".join(["tofscope", *command, "--help"]), times))
    both = [list(zip(*each, strict=True)) for each in _in_turns(folders, view)]
    for i, what in enumerate(("address printed", "first pair drawn")):
        print(_line(f"tofscope view, {what}", [each[i] for each in both]))


def _in_turns(folders: list[Path], measured: Callable[[Path], Any]) -> list[list[Any]]:
    for folder in folders:
        measured(folder)  # files are read from the disk once
    rounds = [[measured(folder) for folder in folders] for _ in range(_ROUNDS)]
    return [list(each) for each in zip(*rounds, strict=True)]


def _line(what: str, times: list[Any]) -> str:
    ours, *others = (statistics.median(each) for each in times)
    compared = "".join(f", the other {other:.2f} s: {other / ours:.1f}x" for other in others)
    return f"{what:45} {ours:.2f} s{compared}"


if __name__ == "__main__":
    main()
