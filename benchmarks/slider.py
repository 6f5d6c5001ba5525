"""From a slider's event to new arrows on the wire: alone, and while plots are filled.

Run it from the project's folder: `.venv/bin/python -m benchmarks.slider`.
"""

import statistics
import time
from collections.abc import Callable
from typing import Any

from app.analysis.estimates import Estimates, warm_up
from app.analysis.library import Library
from app.scene.clouds_view import FLOW_NODE
from app.server.session import Session, Shared
from app.session.reload import Reloads
from estimator import Parameters
from recordings import open_recording, sample_paths
from tests.app.fake_client import FakeClient

_VALUES = (4, 5, 6, 7, 9, 10, 11)  # of n, each of which draws other arrows
_PAUSE = 0.5  # seconds between two events: the background is at work again when the next comes
_TIMEOUT = 20.0  # seconds


def _wait(condition: Callable[[], bool]) -> None:
    end = time.perf_counter() + _TIMEOUT
    while not condition():
        if time.perf_counter() > end:
            raise TimeoutError("Nothing was drawn in time.")
        time.sleep(5e-4)


def _has_flow(client: Any) -> bool:  # noqa: ANN401 (stands in for a client of viser)
    return any(getattr(message, "name", None) == FLOW_NODE for message in list(client.sent))


def measure(*, plots: bool) -> list[float]:
    """Milliseconds of each event, without cached results."""
    shared = Shared(Library(sample_paths(), open_recording), Estimates(), Reloads(), Parameters())
    if not plots:
        setattr(shared.surveys, "request", lambda *_: None)  # noqa: B010 (the type checker minds)
    with FakeClient.on_a_server() as client:
        session = Session(client, shared)
        _wait(lambda: "Moving" in client.text())
        times = []
        for n in _VALUES:
            time.sleep(_PAUSE)
            client.take_sent()
            start = time.perf_counter()
            client.change("n", n)
            _wait(lambda: _has_flow(client))
            times.append(1e3 * (time.perf_counter() - start))
        session.close()
        session.join(_TIMEOUT)
    return times


def main() -> None:
    """Print medians, largest values and the ratio."""
    warm_up()
    alone, filling = measure(plots=False), measure(plots=True)
    for name, times in (("alone", alone), ("while plots are filled", filling)):
        print(f"{name:24} median {statistics.median(times):6.1f} ms  largest {max(times):6.1f} ms")
    print(
        f"{'ratio of the medians':24} {statistics.median(filling) / statistics.median(alone):.2f}"
    )


if __name__ == "__main__":
    main()
