"""200 slider events in a second end on the last of them, on the wire."""

import re
import time

from app.analysis.estimates import Estimates
from app.analysis.library import Library
from app.scene.clouds_view import FLOW_NODE
from app.server.server import Server
from app.server.session import Shared
from app.session.reload import Reloads
from estimator import Parameters
from tests.app.fake_recordings import PERIOD, fake_recording
from tests.app.waiting import until
from tests.app.wire_client import WireClient

EVENTS = 200


class Drawn:
    """The interval of every picture that came, in seconds, and how often arrows came."""

    def __init__(self):
        self.intervals, self.arrows = [], 0

    def listen(self, _, message):
        updates = message.get("updates", {})
        self.arrows += message.get("name") == FLOW_NODE and "points" in updates
        found = re.search(
            r"Δt of the pair</span><span[^>]*>([0-9.]+) s", str(updates.get("content"))
        )
        if found:
            self.intervals.append(float(found[1]))


def test_a_flood_of_slider_events_ends_on_the_last_value(tmp_path):
    (tmp_path / "a.mcap").touch()
    library = Library([tmp_path], lambda path: fake_recording(name=path.stem))
    shared = Shared(library, Estimates(), Reloads(), Parameters())
    server, drawn = Server(shared, "127.0.0.1", 0), Drawn()
    try:
        with WireClient(server.address, drawn.listen) as client:
            until(lambda: drawn.intervals)
            for last in (5, 11):
                drawn.arrows, pictures = 0, len(drawn.intervals)
                start = time.monotonic()
                for number in range(EVENTS - 1):
                    client.change("n", 1 + number % 15)
                    time.sleep(max(0.0, start + (number + 1) / EVENTS - time.monotonic()))
                client.change("n", last)
                until(lambda last=last: abs(drawn.intervals[-1] - last * PERIOD) < 1e-3)
                time.sleep(0.7)  # nothing that was late comes after it
                assert abs(drawn.intervals[-1] - last * PERIOD) < 1e-3
                assert client.value("n") == last
                assert 0 < drawn.arrows < EVENTS
                assert 0 < len(drawn.intervals) - pictures < EVENTS
    finally:
        server.close()
