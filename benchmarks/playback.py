"""Frames per second received by a client while a recording is played.

Run it from the project's folder: `.venv/bin/python -m benchmarks.playback`.
"""

import argparse
import re
import statistics
import tempfile
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from functools import partial
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


class Frames:
    """What a client was sent of the frames that it was shown.

    Attributes:
        clouds: seconds at which clouds came.
        numbers: of the frames, each told after its cloud.
        drawn: seconds at which the last number came.
    """

    def __init__(self) -> None:
        self.clouds: list[float] = []
        self.numbers: list[int] = []
        self.drawn = 0.0
        self._drawn = False  # whether a cloud came since the last number

    def listen(self, now: float, message: dict[str, Any]) -> None:
        """Note a message."""
        if message["type"] == "SceneNodeUpdateMessage" and message["name"] in _CLOUDS:
            if "points" in message["updates"] and not self._drawn:
                self.clouds.append(now)
                self._drawn = True
        elif found := _SHOWN_FRAME.fullmatch(str(message.get("source"))):
            self.drawn = now
            self.numbers.append(int(found[1]))
            self._drawn = False

    def forget(self) -> None:
        """Begin anew."""
        self.clouds.clear()
        self.numbers.clear()
        self._drawn = False


@dataclass(frozen=True)
class Played:
    """What came while a recording was played.

    Attributes:
        times: seconds at which clouds came, three or more.
        numbers: frames that came.
        used: share of a processor.
        received: bytes, all messages together.
        seconds: that it was played.
    """

    times: list[float]
    numbers: list[int]
    used: float
    received: int
    seconds: float

    @property
    def bytes_a_frame(self) -> float:
        """Bytes of all messages for each cloud that came."""
        return self.received / len(self.times)


@contextmanager
def playing(*paths: Path) -> Iterator[Callable[[float, float], Played | None]]:
    """Serve recordings to one client; gives what plays them at a speed for a time in seconds."""
    frames = Frames()
    with serving(*paths) as served, WireClient(served.address, frames.listen) as client:
        wait_until(lambda: frames.clouds, 120)
        time.sleep(_SETTLE)
        yield partial(_from_the_start, served, client, frames)


def _from_the_start(
    served: Served, client: WireClient, frames: Frames, speed: float, seconds: float
) -> Played | None:
    client.trigger("First frame")
    time.sleep(1.0)
    return play(served, client, frames, speed, seconds)


def play(
    served: Served, client: WireClient, frames: Frames, speed: float, seconds: float
) -> Played | None:
    """Play from the current frame; None where hardly anything came."""
    client.tell("playback", {"speed": speed, "loop": True})
    frames.forget()
    before, start, received = served.seconds(), time.perf_counter(), client.received
    client.trigger("Play or pause")
    time.sleep(seconds)
    used = (served.seconds() - before) / (time.perf_counter() - start)
    times, numbers = list(frames.clouds), list(frames.numbers)
    received = client.received - received
    client.trigger("Play or pause")
    return Played(times, numbers, used, received, seconds) if len(times) >= 3 else None


def _line(played: Played) -> str:
    times, numbers = played.times, played.numbers
    gaps = [1e3 * (b - a) for a, b in pairwise(times)]
    rate = (len(times) - 1) / (times[-1] - times[0])
    steps = [b - a for a, b in pairwise(numbers) if b > a]  # a loop goes back to its start
    return (
        f"{rate:5.1f} frames/s over {times[-1] - times[0]:.1f} s; gaps median "
        f"{statistics.median(gaps):.0f} ms, longest {max(gaps):.0f} ms; "
        f"{sum(steps) - len(steps)} of {sum(steps)} frames left out; {100 * played.used:.0f} % of "
        f"a processor, {played.received / played.seconds / 1e6:.2f} MB/s"
    )


def measure(name: str, *paths: Path, seconds: float) -> None:
    """Print the rates at several speeds."""
    print(f"{name} ({machine()})", flush=True)
    with playing(*paths) as play:
        for speed in (1.0, 5.0):
            played = play(speed, seconds)
            print(f"  {speed:4g}x: {_line(played) if played else 'nothing came'}", flush=True)


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
