"""An hour of a recording, alone and in the app, beside a recording of two seconds.

Run: python -m benchmarks.long [--recording HOUR.mcap]
"""

import argparse
import contextlib
import io
import multiprocessing
import shutil
import tempfile
import time
from collections.abc import Callable
from pathlib import Path
from typing import TypeVar

import numpy as np

from app.command_line import main as tofscope
from benchmarks.long_in_app import report
from benchmarks.serving import machine
from recordings import open_recording
from recordings.stamp_index import STAMP_INDEX

_Result = TypeVar("_Result")
_HOUR, _SHORT = 3600, 2
_POSE_RATE = 1000
_TAIL = 2**26  # bytes at the end of a file, where its attachments are
_OPENINGS, _SEEKS, _SEEKS_FOR_MEMORY = 7, 30, 200


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--recording", type=Path, help="the hour, if it is there already")
    parser.add_argument("--folder", type=Path, help="for files (default: a temporary one)")
    options = parser.parse_args()
    print(machine())
    with tempfile.TemporaryDirectory(dir=options.folder) as name:
        folder = Path(name)
        short, hour = folder / "short.mcap", options.recording or folder / "hour.mcap"
        _make(short, _SHORT)
        if options.recording is None:
            print(f"write an hour        {_make(hour, _HOUR):9.1f} s")
        bare = _without_index(hour, folder / "bare.mcap")
        print(f"size                 {hour.stat().st_size / 1e6:9.0f} MB")
        base = 1e3 * _alone(_opening, short)
        print(f"open {_SHORT} s             {base:9.1f} ms")
        for what, path in (("with index", hour), ("without index", bare)):
            took = 1e3 * _alone(_opening, path)
            print(f"open an hour         {took:9.1f} ms, {took - base:+.1f} ms   {what}")
        for what, path in (("with index", hour), ("without index", bare)):
            median, worst = _alone(_seeking, path)
            print(f"seek                 {median:9.1f} ms median, {worst:.1f} ms worst   {what}")
        print(f"memory, 2 s          {_alone(_memory, short):9.0f} MB")
        for what, path in (("with index", hour), ("without index", bare)):
            print(f"memory, an hour      {_alone(_memory, path):9.0f} MB   {what}")
        print(f"truth of all frames  {_alone(_truth, hour):9.1f} s")
        report(short, [hour, bare])


def _make(path: Path, seconds: int) -> float:
    """Make a recording, and return the seconds that it took."""
    begin = time.perf_counter()
    flags = ["--duration", str(seconds), "--pose-rate", str(_POSE_RATE), "--out", str(path)]
    with contextlib.redirect_stdout(io.StringIO()):
        assert tofscope(["simulate", "robot_moving", *flags]) == 0
    return time.perf_counter() - begin


def _without_index(path: Path, copy: Path) -> Path:
    """Copy a recording; the copy's index of stamps has a name that nothing looks for."""
    shutil.copyfile(path, copy)
    name, tail = STAMP_INDEX.encode(), min(_TAIL, copy.stat().st_size)
    with copy.open("r+b") as stream:
        start = stream.seek(-tail, 2)
        data = stream.read().replace(name, b"x" * len(name))
        stream.seek(start)
        stream.write(data)
    return copy


def _alone(measure: Callable[[Path], _Result], path: Path) -> _Result:
    """What is measured in a process of its own."""
    with multiprocessing.get_context("spawn").Pool(1) as pool:
        return pool.apply(measure, (path,))


def _opening(path: Path) -> float:
    """Median seconds of an opening, after a first one."""
    open_recording(path).close()
    took: list[float] = []
    for _ in range(_OPENINGS):
        begin = time.perf_counter()
        recording = open_recording(path)
        took.append(time.perf_counter() - begin)
        recording.close()
    return float(np.median(took))


def _seeking(path: Path) -> tuple[float, float]:
    """Median and largest milliseconds of going to a frame far away."""
    took: list[float] = []
    with open_recording(path) as recording:
        recording.cloud(0)
        for k in _frames(len(recording), _SEEKS):
            begin = time.perf_counter()
            recording.cloud(k)
            recording.link_poses(k)
            took.append(1e3 * (time.perf_counter() - begin))
    return float(np.median(took)), max(took)


def _memory(path: Path) -> float:
    """Largest MB of the process after going to many frames (Linux alone tells)."""
    with open_recording(path) as recording:
        for k in _frames(len(recording), _SEEKS_FOR_MEMORY):
            recording.cloud(k)
            recording.link_poses(k)
            recording.truth(k)
    status = Path("/proc/self/status").read_text().splitlines()
    return float(next(line for line in status if line.startswith("VmHWM:")).split()[1]) / 1024


def _truth(path: Path) -> float:
    """Seconds that the truth of all frames takes."""
    with open_recording(path) as recording:
        begin = time.perf_counter()
        for k in range(len(recording)):
            recording.truth(k)
        return time.perf_counter() - begin


def _frames(count: int, seeks: int) -> list[int]:
    return np.random.default_rng(0).integers(1, count, seeks).tolist()


if __name__ == "__main__":
    main()
