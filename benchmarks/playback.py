"""Frames per second received by a client while a recording is played.

Run it from the project's folder: `.venv/bin/python -m benchmarks.playback`.
"""

import argparse
import re
import statistics
import tempfile
import time
from itertools import pairwise
from pathlib import Path
from typing import Any

from app.scene.clouds_view import STATIC_TARGET_NODE, TARGET_NODE
from benchmarks.serving import Served, machine, serving, wait_until, write_long_recording
from tests.app.wire_client import WireClient

_SETTLE = 3.0  # seconds after opening, in which plots begin to be filled
_FRAMES = 10_000
_CLOUDS = (TARGET_NODE, STATIC_TARGET_NODE)  # without a flow the points are all in the first
_SHOWN_FRAME = re.compile(r"window\.tofscope\.timeline\.frame\((\d+)\);")


class _Frames:
    """Arrival times of clouds, and numbers of the frames that arrived."""

    def __init__(self) -> None:
        self.clouds: list[float] = []
        self.numbers: list[int] = []
        self._drawn = False  # whether a cloud came since the last number

    def listen(self, now: float, message: dict[str, Any]) -> None:
        if message["type"] == "SceneNodeUpdateMessage" and message["name"] in _CLOUDS:
            if "points" in message["updates"] and not self._drawn:
                self.clouds.append(now)
                self._drawn = True
        elif found := _SHOWN_FRAME.fullmatch(str(message.get("source"))):
            self.numbers.append(int(found[1]))
            self._drawn = False

    def forget(self) -> None:
        self.clouds.clear()
        self.numbers.clear()
        self._drawn = False


def _play(served: Served, client: WireClient, frames: _Frames, speed: float, seconds: float) -> str:
    client.tell("playback", {"speed": speed, "loop": True})
    client.trigger("First frame")
    time.sleep(1.0)
    frames.forget()
    before, start, received = served.seconds(), time.perf_counter(), client.received
    client.trigger("Play or pause")
    time.sleep(seconds)
    used = (served.seconds() - before) / (time.perf_counter() - start)
    times, numbers = list(frames.clouds), list(frames.numbers)
    client.trigger("Play or pause")
    if len(times) < 3:
        return f"{speed:4g}x: nothing came"
    gaps = [1e3 * (b - a) for a, b in pairwise(times)]
    rate = (len(times) - 1) / (times[-1] - times[0])
    steps = [b - a for a, b in pairwise(numbers) if b > a]  # a loop goes back to its start
    bandwidth = (client.received - received) / seconds / 1e6
    return (
        f"{speed:4g}x: {rate:5.1f} frames/s over {times[-1] - times[0]:.1f} s; gaps median "
        f"{statistics.median(gaps):.0f} ms, longest {max(gaps):.0f} ms; "
        f"{sum(steps) - len(steps)} of {sum(steps)} frames left out; {100 * used:.0f} % of a "
        f"processor, {bandwidth:.2f} MB/s"
    )


def measure(name: str, *paths: Path, seconds: float) -> None:
    """Print the rates at several speeds."""
    print(f"{name} ({machine()})", flush=True)
    frames = _Frames()
    with serving(*paths) as served, WireClient(served.address, frames.listen) as client:
        wait_until(lambda: frames.clouds, 120)
        time.sleep(_SETTLE)
        for speed in (1.0, 5.0):
            print("  " + _play(served, client, frames, speed, seconds), flush=True)


def main() -> None:
    """Play a sample, which is over soon and begins again, and a long recording."""
    parser = argparse.ArgumentParser()
    parser.add_argument("--seconds", type=float, default=20.0, help="that each speed is played")
    parser.add_argument("--long", type=Path, help="long recording; made where it is not there")
    options = parser.parse_args()
    measure("The first sample, in a loop", seconds=min(options.seconds, 10.0))
    with tempfile.TemporaryDirectory() as folder:
        path = options.long or Path(folder) / "long.mcap"
        if not path.exists():
            write_long_recording(path, _FRAMES)
        measure(f"{_FRAMES} frames", path, seconds=options.seconds)


if __name__ == "__main__":
    main()
