"""Memory of a server while frames are played and scrubbed, and while clients come and go.

Run it from the project's folder: `.venv/bin/python -m benchmarks.memory`.
"""

import argparse
import tempfile
import time
from pathlib import Path
from typing import Any

from app.scene.clouds_view import STATIC_TARGET_NODE
from benchmarks.serving import Served, machine, serving, wait_until, write_long_recording
from tests.app.wire_client import WireClient

_FRAMES = 10_000
_RELEASED = 4.0  # seconds until the memory of a closed session is freed


class _Count:
    """Counter of the frames whose cloud a client has received."""

    def __init__(self) -> None:
        self.frames = 0

    def listen(self, _: float, message: dict[str, Any]) -> None:
        moved = (
            message["type"] == "SceneNodeUpdateMessage" and message["name"] == STATIC_TARGET_NODE
        )
        self.frames += moved and "points" in message["updates"]


def _say(name: str, served: Served) -> None:
    print(f"  {name:28} {served.resident():7.1f} MB, {served.threads()} threads", flush=True)


def scrub(served: Served, frames: int, max_range: float) -> None:
    """Show frame after frame of a recording, as fast as the server draws them."""
    count = _Count()
    with WireClient(served.address, count.listen) as client:
        wait_until(lambda: count.frames, 120)
        wait_until(lambda: client.shown("timeline.frame"))  # it is shown by now
        _say("one client", served)
        client.change("max range", max_range)
        for k in range(frames):
            shown = count.frames
            client.tell("seek", {"frame": k % _FRAMES})
            wait_until(lambda shown=shown: count.frames > shown)
            if (k + 1) % (frames // 10) == 0:
                _say(f"{k + 1} frames scrubbed", served)
    time.sleep(_RELEASED)
    _say("no client any more", served)


def come_and_go(served: Served, clients: int) -> None:
    """Let clients come, see a frame, play and go, five at a time."""
    _say("no client yet", served)
    at_once = 5
    for number in range(0, clients, at_once):
        counts = [_Count() for _ in range(at_once)]
        here = [WireClient(served.address, count.listen) for count in counts]
        for client, count in zip(here, counts, strict=True):
            wait_until(lambda count=count: count.frames, 120)
            client.trigger("Play or pause")
        time.sleep(0.5)
        if number == 0:
            _say(f"{at_once} clients connected", served)
        for client in here:
            client.close()
        if (number + at_once) % (clients // 10) == 0:
            time.sleep(_RELEASED)
            _say(f"{number + at_once} clients gone", served)


def main() -> None:
    """Print both curves."""
    parser = argparse.ArgumentParser()
    parser.add_argument("--frames", type=int, default=_FRAMES, help="that are scrubbed")
    parser.add_argument("--clients", type=int, default=100, help="that come and go")
    parser.add_argument("--long", type=Path, help="long recording; made where it is not there")
    parser.add_argument(
        "--max-range", type=float, default=4.0, help="m; near points alone are estimated sooner"
    )
    options = parser.parse_args()
    if options.clients:
        print(f"Clients come and go: samples ({machine()})", flush=True)
        with serving() as served:
            come_and_go(served, options.clients)
    with tempfile.TemporaryDirectory() as folder:
        path = options.long or Path(folder) / "long.mcap"
        if not path.exists():
            write_long_recording(path, _FRAMES)
        print(f"A recording of {_FRAMES} frames is scrubbed ({machine()})", flush=True)
        with serving(path) as served:
            scrub(served, options.frames, options.max_range)


if __name__ == "__main__":
    main()
