"""An hour of a recording in the app, seen from the wire, beside a recording of two seconds.

Run: python -m benchmarks.long_in_app SHORT.mcap HOUR.mcap [WITHOUT_INDEX.mcap]
"""

import argparse
import random
import statistics
import time
from collections.abc import Iterator
from contextlib import contextmanager
from itertools import pairwise
from pathlib import Path

from benchmarks.playback import Frames, play
from benchmarks.serving import Served, machine, serving, wait_until
from tests.app.wire_client import WireClient

_SERVERS, _AGAIN, _SEEKS = 3, 5, 30
_SETTLE = 5.0  # seconds after opening, in which the survey has begun
_LIMIT = 120.0  # seconds that anything may take


def main() -> None:
    """Print the table of recordings that are there."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("short", type=Path)
    parser.add_argument("hours", type=Path, nargs="+")
    parser.add_argument("--seconds", type=float, default=20.0, help="that the hour is played")
    options = parser.parse_args()
    print(machine())
    report(options.short, options.hours, options.seconds)


def report(short: Path, hours: list[Path], seconds: float = 20.0) -> None:
    """Print opening, seeking, playing and memory of hours, beside a short recording.

    Args:
        short: some seconds.
        hours: of the same kind.
        seconds: that each is played.
    """
    for name, measure in (("new server", _first_picture), ("opened again", _again)):
        took = measure([short, *hours])
        base = took[short]
        print(f"app, {short.stem:12} {1e3 * base:9.0f} ms to the first picture, {name}")
        for path in hours:
            more = 1e3 * (took[path] - base)
            print(f"app, {path.stem:12} {1e3 * took[path]:9.0f} ms, {more:+.0f} ms, {name}")
    for path in hours:
        _use(path, seconds)


def _first_picture(paths: list[Path]) -> dict[Path, float]:
    """Median seconds from a page's first words to a server, to its first cloud and frame."""
    took: dict[Path, list[float]] = {path: [] for path in paths}
    for _ in range(_SERVERS):
        for path in paths:
            with serving(path) as served:
                begin = time.perf_counter()
                with _looking(served) as (_, frames):
                    took[path].append(frames.drawn - begin)
    return {path: statistics.median(values) for path, values in took.items()}


def _again(paths: list[Path]) -> dict[Path, float]:
    """Median seconds from the choice of another recording to its first cloud and frame."""
    took: dict[Path, list[float]] = {path: [] for path in paths}
    with serving(*paths) as served, _looking(served) as (client, frames):
        for _ in range(_AGAIN):
            for path in (*paths[1:], paths[0]):
                frames.forget()
                begin = time.perf_counter()
                client.tell("recordings.choose", {"label": path.stem})
                wait_until(lambda: frames.numbers, _LIMIT)
                took[path].append(frames.drawn - begin)
                time.sleep(1.0)
    return {path: statistics.median(values) for path, values in took.items()}


def _use(path: Path, seconds: float) -> None:
    """Seek and play while the survey goes on, and print what it took."""
    with serving(path) as served, _looking(served) as (client, frames):
        time.sleep(_SETTLE)
        most, received, begin = served.resident(), client.received, time.perf_counter()
        time.sleep(_SETTLE)
        rate = (client.received - received) / (time.perf_counter() - begin)
        print(f"  {path.stem}: {rate / 1e3:.0f} kB/s while the survey goes on, {most:.0f} MB")
        took = [_seek(client, frames, k) for k in _places(_count(client))]
        most = max(most, served.resident())
        print(
            f"  seek to the wire     {1e3 * statistics.median(took):9.0f} ms median, "
            f"{1e3 * max(took):.0f} ms worst, {most:.0f} MB"
        )
        client.tell("seek", {"frame": _count(client) // 3})
        time.sleep(1.0)
        played = play(served, client, frames, 1.0, seconds)
        most = max(most, served.resident())
        if played is None:
            print("  play                 nothing came")
            return
        gaps = [1e3 * (b - a) for a, b in pairwise(played.times)]
        rate = (len(played.times) - 1) / (played.times[-1] - played.times[0])
        print(
            f"  play at 1x           {rate:9.2f} frames/s, gaps {statistics.median(gaps):.0f} ms "
            f"median, {max(gaps):.0f} ms longest, {played.bytes_a_frame / 1e3:.0f} kB a frame, "
            f"{100 * played.used:.0f} % of a processor"
        )
        print(f"  memory               {served.peak():9.0f} MB at most")


def _seek(client: WireClient, frames: Frames, frame: int) -> float:
    """Seconds until a frame far away was drawn."""
    frames.forget()
    begin = time.perf_counter()
    client.tell("seek", {"frame": frame})
    wait_until(lambda: frame in frames.numbers, _LIMIT)
    return frames.drawn - begin


def _places(count: int) -> list[int]:
    return random.Random(0).sample(range(100, count), _SEEKS)


def _count(client: WireClient) -> int:
    """Number of the recording's frames, all of which are played."""
    shown = client.shown("timeline.playback")
    assert shown is not None
    return shown[0]["last"] + 1


@contextmanager
def _looking(served: Served) -> Iterator[tuple[WireClient, Frames]]:
    """A client that has seen its first frame."""
    frames = Frames()
    with WireClient(served.address, frames.listen) as client:
        wait_until(lambda: frames.numbers, _LIMIT)
        yield client, frames


if __name__ == "__main__":
    main()
