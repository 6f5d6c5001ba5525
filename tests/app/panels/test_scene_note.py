from dataclasses import replace

import pytest

from app.analysis.survey import Survey
from app.panels.scene_note import SceneNotePanel
from estimator import Parameters
from tests.app.fake_recordings import fake_opened
from tests.app.fake_session import context, snapshot

STILL = Parameters(delta=5.0)  # metres: nothing moves that far


class Note:
    """The panel, and what it has the page say."""

    def __init__(self, client):
        self._client = client
        self._panel = SceneNotePanel(context(client))
        client.take_sent()

    def says(self, **changes):
        self._panel.show(snapshot(**changes))
        ((content,),) = self._client.called("note.show")
        return content


@pytest.fixture
def note(client):
    return Note(client)


def survey(parameters: Parameters, *moving_at: int, complete: bool = True) -> Survey:
    """With five moving points at some frames."""
    made = Survey(fake_opened().recording, parameters)
    made.done[:] = complete
    made.moving[:] = 0.0
    made.moving[list(moving_at)] = 5.0
    return made


def test_where_something_moves_nothing_is_said(note):
    assert note.says(frame=20) == {"text": "", "actions": []}


def test_it_leads_to_the_next_frame_at_which_something_moves(note):
    found = note.says(frame=20, parameters=STILL, survey=survey(STILL, 12, 25, 30))
    assert "below δ" in found["text"]
    assert found["actions"] == [["To the next motion", "Frame 25", "seek", {"frame": 25}]]


def test_after_the_last_motion_it_leads_back_to_its_last_frame(note):
    found = note.says(frame=20, parameters=STILL, survey=survey(STILL, 11, 12))
    assert found["actions"] == [["Back to the last motion", "Frame 12", "seek", {"frame": 12}]]


def test_where_nothing_moves_at_any_frame_it_says_so_and_leads_nowhere(note):
    found = note.says(frame=20, parameters=STILL, survey=survey(STILL))
    assert found["text"].endswith("With these parameters no frame has any motion.")
    assert found["actions"] == []


def test_until_every_frame_is_estimated_it_leads_to_what_is_known_of_the_recording(note):
    known = replace(snapshot().timeline, moving=((5, 9), (25, 30)))
    filling = survey(Parameters(), 35, complete=False)
    found = note.says(frame=20, parameters=STILL, survey=filling, timeline=known)
    assert found["actions"] == [["To the next motion", "Frame 25", "seek", {"frame": 25}]]
