"""Helpers of the app's benchmarks: a server in its own process, and a long recording."""

import itertools
import os
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from recordings.frame import Provenance
from recordings.simulation import NOISE_MODELS, SCENARIOS, simulate
from recordings.writer import RecordingWriter
from robot_assets import load_rig, load_robot

_SERVE = "import sys; from app.command_line import main; sys.exit(main())"


@dataclass(frozen=True)
class Served:
    """A running `tofscope view`."""

    address: str
    process: int

    def resident(self) -> float:
        """MB of memory that the server has in use (Linux alone tells)."""
        return self._status("VmRSS") / 1024

    def peak(self) -> float:
        """MB of memory that it had in use at most (Linux alone tells)."""
        return self._status("VmHWM") / 1024

    def threads(self) -> int:
        """Number of the server's threads."""
        return int(self._status("Threads"))

    def seconds(self) -> float:
        """Seconds of processor time that the server has used."""
        fields = Path(f"/proc/{self.process}/stat").read_text().rsplit(")", 1)[1].split()
        return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")

    def _status(self, name: str) -> float:
        for line in Path(f"/proc/{self.process}/status").read_text().splitlines():
            if line.startswith(f"{name}:"):
                return float(line.split()[1])
        raise LookupError(name)


@contextmanager
def serving(*paths: Path, folder: Path | None = None) -> Iterator[Served]:
    """Serve recordings, the samples where none is given, as `tofscope view` does.

    Args:
        paths: of the recordings.
        folder: checkout of the project whose server it is, by default the current one.
    """
    command = [sys.executable, "-c", _SERVE, "view", "--port", "0", *map(str, paths)]
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True, cwd=folder) as process:
        try:
            assert process.stdout is not None
            yield Served(process.stdout.readline().split()[-1], process.pid)
        finally:
            process.terminate()


def write_long_recording(path: Path, frames: int) -> None:
    """Write one simulated recording again and again until it has that many frames."""
    rig, robot, scenario = load_rig(), load_robot(), SCENARIOS["robot_moving"]
    noise = NOISE_MODELS["paper"]
    about = Provenance(
        simulated=True,
        scenario=scenario.name,
        speed=0.25,
        trial=1,
        seed=0,
        noise=noise.name,
        command="python -m benchmarks.playback",
    )
    once = list(simulate(scenario, speed=0.25, trial=1, seed=0, noise=noise, robot=robot, rig=rig))
    period = once[1].stamp - once[0].stamp
    with RecordingWriter(path, robot, rig, about) as writer:
        for k, frame in enumerate(itertools.islice(itertools.cycle(once), frames)):
            writer.write(replace(frame, stamp=once[0].stamp + k * period))


def wait_until(condition: Callable[[], Any], seconds: float = 60.0) -> None:
    """Poll a condition until it is true."""
    end = time.perf_counter() + seconds
    while not condition():
        if time.perf_counter() > end:
            raise TimeoutError(f"The condition is still false after {seconds:g} s.")
        time.sleep(5e-4)


def machine() -> str:
    """Number of processors and their load."""
    return f"{os.cpu_count()} processors, load {os.getloadavg()[0]:.1f}"
