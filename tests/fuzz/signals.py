"""Signals at random moments of every command: how it ends, what it says, and what it leaves.

Run it from the project's folder: `.venv/bin/python -m tests.fuzz.signals`, or with the names of
some commands, and `--runs`, `--seed`. It takes about half an hour, and works on Linux alone.
"""

import argparse
import ctypes
import os
import random
import signal
import subprocess
import sys
import tempfile
import time
from collections import Counter
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from dataclasses import dataclass, field
from pathlib import Path

from app.commands.signals import STOPPED
from recordings import sample_paths
from tests.conftest import REPOSITORY

_SAMPLE = str(sample_paths()[0])
_SIMULATED = ("--speed", "1", "--trial", "1")
_COMMANDS = {
    "info": ("info", _SAMPLE),
    "evaluate": ("evaluate", _SAMPLE, "--json", "out/table.json"),
    "simulate": ("simulate", "towards", *_SIMULATED, "--out", "out"),
    "page": ("export", _SAMPLE, "--html", "out/page.html"),
    "picture": ("export", _SAMPLE, "--screenshot", "out/picture.png", "--size", "320x240"),
    "study": (
        *("study", "--scenario", "towards", "robot_moving", *_SIMULATED, "--method", "baseline"),
        *("--sweep", "--jobs", "2", "--out", "out"),
    ),
    "view": ("view", _SAMPLE, "--port", "0"),
}
"""{name: arguments}; what they write is in the folder `out`."""
_WAYS = ("ctrl-c", "term", "kill")
"""Ctrl-C as a terminal does it, to all processes of the group; SIGTERM and SIGKILL to the first."""
_NUMBERS = {"ctrl-c": signal.SIGINT, "term": signal.SIGTERM, "kill": signal.SIGKILL}
_EARLY = 0.2
"""Seconds in which every fourth signal comes: while Python starts and modules load."""
_PATIENCE = 30.0
"""Seconds within which a command must have ended."""
_AFTER = 3.0
"""Seconds that its other processes have to end, too."""
_ENDINGS = {
    ".json": b"}\n",
    ".mcap": b"\x89MCAP0\r\n",
    ".html": b"</html>",
    ".png": b"IEND\xaeB`\x82",
}
"""Last bytes of whole files."""


@dataclass
class Found:
    """What the signals of a command have shown."""

    codes: Counter[int] = field(default_factory=Counter)
    early: int = 0
    longest: float = 0.0
    faults: list[str] = field(default_factory=list)


class Run:
    """A command in a folder of its own, with a folder for temporary files."""

    def __init__(self, arguments: tuple[str, ...], folder: Path) -> None:
        self.folder = folder
        self._arguments = arguments
        for name in ("out", "tmp"):
            (folder / name).mkdir(exist_ok=True)
        self.said = folder / "said.txt"
        self.begun = time.monotonic()
        with self.said.open("wb") as said, (folder / "printed.txt").open("wb") as printed:
            self.process = subprocess.Popen(
                [Path(sys.executable).with_name("tofscope"), *arguments],
                cwd=folder,
                env=os.environ
                | {"PYTHONPATH": str(REPOSITORY), "TMPDIR": str(folder / "tmp")}
                | {"OMP_NUM_THREADS": "1"},
                stdin=subprocess.DEVNULL,
                stdout=printed,
                stderr=said,
                start_new_session=True,
            )

    def until_done(self) -> float:
        """Seconds until it has ended, or, as it would never, has served for a second."""
        printed = self.folder / "printed.txt"
        if self._arguments[0] == "view":
            while b"http" not in printed.read_bytes():
                time.sleep(0.05)
            time.sleep(1.0)
            self.send("term")
        self.process.wait(120)
        return time.monotonic() - self.begun

    def send(self, way: str) -> None:
        """Send a signal."""
        if self.process.poll() is None:
            if way == "ctrl-c":
                os.killpg(self.process.pid, signal.SIGINT)
            else:
                self.process.send_signal(_NUMBERS[way])

    def handles_signals(self) -> bool:
        """Whether our code has begun, or is over: Python alone does not handle SIGTERM."""
        with suppress(OSError):
            for line in Path(f"/proc/{self.process.pid}/status").read_text().splitlines():
                name, _, value = line.partition(":")
                if name in ("SigCgt", "SigIgn") and int(value, 16) >> (signal.SIGTERM - 1) & 1:
                    return True
            return self.process.poll() is not None
        return True

    def left(self) -> list[str]:
        """Files that should not be there: scratch, drafts, and outputs that are not whole."""
        scratch = [str(path.relative_to(self.folder)) for path in (self.folder / "tmp").iterdir()]
        for path in (self.folder / "out").rglob("*"):
            name = str(path.relative_to(self.folder))
            if path.suffix == ".part" or path.name.startswith("."):
                scratch.append(name)
            elif (end := _ENDINGS.get(path.suffix)) and not path.read_bytes().rstrip(
                b"\n"
            ).endswith(end.rstrip(b"\n")):
                scratch.append(f"{name}, which is not whole")
        return scratch


def processes() -> dict[int, str]:
    """{number: command} of all descendants of this process that run; ended ones are reaped."""
    with suppress(ChildProcessError):
        while os.waitpid(-1, os.WNOHANG)[0]:
            pass
    parents: dict[int, tuple[int, str, str]] = {}
    for path in Path("/proc").glob("[0-9]*"):
        with suppress(OSError):
            head, _, tail = (path / "stat").read_text().rpartition(")")
            state, parent = tail.split()[:2]
            command = (path / "cmdline").read_bytes().replace(b"\0", b" ").decode(errors="replace")
            parents[int(path.name)] = int(parent), state, command or head
    ours, found = {os.getpid()}, {}
    while more := {n for n, (parent, _, _) in parents.items() if parent in ours} - ours:
        ours |= more
        found |= {n: parents[n][2] for n in more if parents[n][1] != "Z"}
    return found


@contextmanager
def adopting() -> Iterator[None]:
    """Context in which processes whose parent has ended become ours, so that none is missed."""
    subreaper = 36  # PR_SET_CHILD_SUBREAPER
    libc = ctypes.CDLL(None)
    libc.prctl(subreaper, 1, 0, 0, 0)
    yield
    libc.prctl(subreaper, 0, 0, 0, 0)


def stopped(name: str, way: str, moment: float, folder: Path, found: Found) -> None:
    """Run a command, send it a signal, and note what is wrong afterwards."""
    run = Run(_COMMANDS[name], folder)
    time.sleep(max(0.0, moment - (time.monotonic() - run.begun)))
    early = not run.handles_signals()
    run.send(way)
    sent = time.monotonic()
    what = f"{name}, {way} at {moment:.2f} s"
    try:
        code = run.process.wait(_PATIENCE)
    except subprocess.TimeoutExpired:
        if not early:
            found.faults.append(f"{what}: still there after {_PATIENCE:.0f} s")
        run.process.kill()
        code = run.process.wait()
    found.longest = max(found.longest, 0.0 if early else time.monotonic() - sent)
    found.codes[code] += 1
    said = run.said.read_text(errors="replace")
    found.early += early
    if not early and way != "kill":
        if code not in (0, STOPPED):
            found.faults.append(f"{what}: exit code {code}, said {said!r}")
        elif said.count("\n") > 1 or "Traceback" in said:
            found.faults.append(f"{what}: said {said!r}")
    while (alive := processes()) and time.monotonic() - sent < _AFTER:
        time.sleep(0.05)
    for number, command in alive.items():
        found.faults.append(f"{what}: process left: {command[:100]}")
        with suppress(ProcessLookupError):
            os.kill(number, signal.SIGKILL)
    if way == "kill":
        if said := run.said.read_text(errors="replace"):
            found.faults.append(f"{what}: said {said!r}")
        # A process that is killed cleans up nothing: the next one does.
        Run(_COMMANDS[name], folder).until_done()
    found.faults += [f"{what}: file left: {file}" for file in run.left()]


def main() -> None:
    """Send the signals, and print what they have shown; exit code 1 where anything is wrong."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").split("\n")[0])
    parser.add_argument("commands", nargs="*", choices=[[], *_COMMANDS], metavar="COMMAND")
    parser.add_argument("--runs", type=int, default=20, help="signals for each (default 20)")
    parser.add_argument("--ways", nargs="+", choices=_WAYS, default=_WAYS)
    parser.add_argument("--seed", type=int, default=0)
    options = parser.parse_args()
    moments, wrong = random.Random(options.seed), False
    with adopting(), tempfile.TemporaryDirectory(dir="/tmp") as scratch:
        for name in options.commands or _COMMANDS:
            folder = Path(scratch) / name
            folder.mkdir()
            whole = Run(_COMMANDS[name], folder).until_done()
            for way in options.ways:
                found = Found()
                for number in range(options.runs):
                    moment = moments.uniform(0, _EARLY if number % 4 == 0 else whole)
                    own = Path(scratch) / f"{len(os.listdir(scratch))}"  # short, for Chromium
                    own.mkdir()
                    stopped(name, way, moment, own, found)
                codes = ", ".join(f"{n} x {code}" for code, n in sorted(found.codes.items()))
                print(
                    f"{name:9} {way:7} {options.runs} in {whole:4.1f} s: exit codes {codes}; "
                    f"{found.early} before it handles signals; ended within "
                    f"{found.longest:.1f} s; {len(found.faults)} faults",
                    flush=True,
                )
                for fault in found.faults:
                    print(f"  {fault}", flush=True)
                wrong = wrong or bool(found.faults)
    raise SystemExit(int(wrong))


if __name__ == "__main__":
    main()
