"""Latency of a dragged slider at the WebSocket: one client, five at once, and a flood of events.

Run it from the project's folder: `.venv/bin/python -m benchmarks.dragging`.
"""

import re
import statistics
import time
from typing import Any

from app.scene.clouds_view import FLOW_NODE
from benchmarks.serving import Served, machine, serving, wait_until
from tests.app.wire_client import WireClient

_VALUES = (4, 5, 6, 7, 8, 9, 10, 11, 12)
_PAUSE = 0.3  # seconds between single events
_EVERY = 0.05  # seconds between the events of a dragged slider
_DRAGGED = 5.0  # seconds
_FIRST, _APART = 13, 3  # frames
_RATE = 15.0  # frames per second of the samples
_FLOOD = 200  # events in a second
_INTERVAL = re.compile(r">Δt of the pair</span><span[^>]*>([0-9.]+) s<")


class _Hand:
    """Client that moves a slider and records the answers.

    Attributes:
        latencies: milliseconds from an event to its arrows.
        drawn: (time, value) of every picture.
    """

    def __init__(self, served: Served, frame: int | None) -> None:
        self.latencies: list[float] = []
        self.drawn: list[tuple[float, int]] = []
        self._sent: dict[int, float] = {}
        self._arrows = 0.0
        self.client = WireClient(served.address, self._listen)
        wait_until(lambda: self.drawn, 120)
        time.sleep(1.0)
        if frame is not None:
            self.client.tell("seek", {"frame": frame})
            time.sleep(1.0)

    def move(self, value: int) -> None:
        self._sent[value] = time.perf_counter()
        self.client.change("n", value)

    def start(self) -> None:
        self.latencies, self.drawn = [], []

    def last(self) -> tuple[float, int]:
        return self.drawn[-1] if self.drawn else (0.0, -1)

    def _listen(self, now: float, message: dict[str, Any]) -> None:
        updates = message.get("updates", {})
        if message.get("name") == FLOW_NODE and "points" in updates:
            self._arrows = now
        elif found := _INTERVAL.search(str(updates.get("content", ""))):
            value = round(float(found[1]) * _RATE)
            self.drawn.append((self._arrows or now, value))
            if value in self._sent and self._arrows > self._sent[value]:
                self.latencies.append(1e3 * (self._arrows - self._sent[value]))


def _statistics(latencies: list[float]) -> str:
    if len(latencies) < 2:
        return "no answers"
    return (
        f"median {statistics.median(latencies):5.0f} ms, 90 % below "
        f"{statistics.quantiles(latencies, n=10)[-1]:5.0f} ms, largest {max(latencies):5.0f} ms"
    )


def one_by_one(served: Served) -> str:
    """Time from an event to its arrows, one event at a time, without cached results."""
    hand = _Hand(served, None)
    found: list[float] = []
    for _ in range(3):  # frames
        for value in _VALUES:
            hand.start()
            hand.move(value)
            wait_until(lambda value=value: hand.last()[1] == value)
            found += hand.latencies[:1]
            time.sleep(_PAUSE)
        hand.client.trigger("Next frame")
        time.sleep(1.0)
    hand.client.close()
    return _statistics(found)


def flood(served: Served) -> str:
    """Time from the last of 200 events within a second until its value is drawn."""
    hand = _Hand(served, None)
    waited = []
    for last in (5, 9, 12):
        hand.start()
        start = time.perf_counter()
        for number in range(_FLOOD):
            hand.move(_VALUES[number % len(_VALUES)] if number < _FLOOD - 1 else last)
            time.sleep(max(0.0, start + (number + 1) / _FLOOD - time.perf_counter()))
        end = time.perf_counter()
        time.sleep(2.0)
        when, value = hand.last()
        assert value == last, f"{value} is drawn instead of {last}"
        waited.append(1e3 * max(when - end, 0.0))
    hand.client.close()
    return "the last value is drawn " + ", ".join(f"{w:.0f} ms" for w in waited) + " after it"


def together(served: Served, count: int) -> list[str]:
    """Picture rate and latency of each client while all drag n, on different frames."""
    hands = [_Hand(served, _FIRST + _APART * number) for number in range(count)]
    for hand in hands:
        hand.start()
    start = time.perf_counter()
    step = 0
    while time.perf_counter() < start + _DRAGGED:
        onward, at = divmod(step, len(_VALUES))
        for number, hand in enumerate(hands):
            if at == 0:  # the next frame has no cached results
                hand.client.tell("seek", {"frame": _FIRST + _APART * number + onward})
            hand.move(_VALUES[at])
        step += 1
        time.sleep(max(0.0, start + step * _EVERY - time.perf_counter()))
    end = time.perf_counter()
    time.sleep(3.0)
    lines = []
    for number, hand in enumerate(hands, 1):
        during = sum(when < end for when, _ in hand.drawn)
        late = 1e3 * max(hand.last()[0] - end, 0.0)
        lines.append(
            f"client {number}: {during / (end - start):4.1f} pictures/s; "
            f"{_statistics(hand.latencies)}; the last {late:.0f} ms after the end"
        )
        hand.client.close()
    return lines


def main() -> None:
    """Print all results, each measured on a fresh server."""
    with serving() as served:
        print(f"One by one ({machine()}): {one_by_one(served)}", flush=True)
    with serving() as served:
        print(f"{_FLOOD} events in a second ({machine()}): {flood(served)}", flush=True)
    for count in (1, 5):
        with serving() as served:
            print(f"{count} dragging at once ({machine()})", flush=True)
            for line in together(served, count):
                print(f"  {line}", flush=True)


if __name__ == "__main__":
    main()
