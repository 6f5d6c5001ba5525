"""A closed tab frees everything."""

import gc
import threading
import weakref
from collections import Counter

import pytest
import viser

from app.analysis.estimates import Estimates
from app.analysis.library import Library
from app.panels.page import Page
from app.scene.scene import Scene
from app.server.server import Server
from app.server.session import Session, Shared
from app.session.followed_survey import FollowedSurvey
from app.session.queue import CommandQueue
from app.session.reload import Reloads
from app.session.workbench import Workbench
from estimator import Parameters
from robot_assets import load_rig, load_robot
from tests.app.drawn import shown_frame
from tests.app.fake_recordings import fake_recording
from tests.app.waiting import until
from tests.app.wire_client import WireClient

OF_ONE_CLIENT = (
    *(Session, CommandQueue, Workbench, FollowedSurvey, Page, Scene),
    *(viser.ClientHandle, viser.SceneNodeHandle),
)

# Results are shared and bounded; for a while they become more. What the last session left is kept
# for its tab, with a comparison or, where the client left before it was made, without one.
REMEMBERED = {
    "app.analysis.estimates",
    "app.analysis.cache",
    "app.analysis.catalogue",
    "app.analysis.pairs",
    "app.analysis.survey",
    "app.analysis.kept_rounds",
    "app.analysis.comparison",
}


_ENDING = ("session", "surveys", "catalogue")


class Seen:
    """Whether what was drawn has come."""

    def __init__(self):
        self.pictures = 0

    def listen(self, _, message):
        # Recording, frame and parameters, which are said once they are drawn.
        self.pictures += "tofscope.corner.show(" in str(message.get("source", ""))


@pytest.fixture
def recordings():
    return []


@pytest.fixture
def server(tmp_path, recordings):
    robot, rig = load_robot(), load_rig()

    def opener(path):
        recordings.append(fake_recording(robot=robot, rig=rig, name=path.stem))
        return recordings[-1]

    for name in ("a.mcap", "b.mcap"):
        (tmp_path / name).touch()
    shared = Shared(Library([tmp_path], opener), Estimates(), Reloads(1), Parameters())
    server = Server(shared, "127.0.0.1", 0)
    yield server
    server.close()


def alive() -> Counter:
    """Count living objects of the app and of viser by type, without those in `REMEMBERED`."""
    gc.collect()
    kinds = [(str(type(thing).__module__), type(thing).__name__) for thing in gc.get_objects()]
    return Counter(
        f"{module}.{name}"
        for module, name in kinds
        if module.startswith(("app.", "viser.")) and module not in REMEMBERED
    )


@pytest.fixture(autouse=True)
def made(monkeypatch) -> list[weakref.ref]:
    """References to what is made for one client.

    Noted as it is made: `gc.get_objects` holds what other threads are just building, too, and a
    tuple that somebody holds cannot be completed.
    """
    found: list[weakref.ref] = []
    for kind in OF_ONE_CLIENT:
        begin = kind.__init__

        def noting(self, *arguments, begin=begin, **options):
            found.append(weakref.ref(self))
            begin(self, *arguments, **options)

        monkeypatch.setattr(kind, "__init__", noting)
    return found


def busy_threads() -> list:
    """Threads of sessions, and the one that goes on for a moment with what they have asked for."""
    return [thread for thread in threading.enumerate() if thread.name in _ENDING]


def visit(server: Server, made: list[weakref.ref]) -> list[weakref.ref]:
    """Come, use the app, and go while it is playing; what was there only for this client."""
    made.clear()
    seen = Seen()
    with WireClient(server.address, seen.listen) as client:
        until(lambda: seen.pictures)
        for act in (
            lambda: client.change("δ", 0.03),
            lambda: client.tell("seek", {"frame": 30}),
            lambda: client.tell("recordings.choose", {"label": "b"}),
        ):
            drawn = seen.pictures
            act()
            until(lambda drawn=drawn: seen.pictures > drawn, 60)  # loads what all use
        client.tell("recordings.look", {})
        client.change("Dark", True)
        client.tell("mark", {"frame": 3, "text": "here"})
        client.trigger("Compare: switch between A and B")
        client.trigger("Play or pause")
        until(lambda: (shown_frame(client) or 0) > 20)
        assert {Session, Workbench, Page, Scene, viser.ClientHandle} <= {type(m()) for m in made}
    return list(made)


def test_a_closed_tab_frees_its_session_scene_handles_and_threads(server, recordings, made):
    found = visit(server, made)
    until(lambda: not busy_threads())
    until(lambda: gc.collect() >= 0 and not any(ref() for ref in found))
    assert recordings
    assert all(recording.closed for recording in recordings)


def test_clients_that_come_and_go_leave_no_more_than_one_did(server, made):
    left = []
    for _ in range(3):
        found = visit(server, made)
        until(lambda: not busy_threads())
        until(lambda found=found: gc.collect() >= 0 and not any(ref() for ref in found))
        left.append(alive())
    # The first loads what all use; a type of which there are fewer than before is fine.
    assert left[2] - left[1] == Counter()
