"""The name of the open recording, the list behind it, and the notes on it."""

from dataclasses import asdict, replace

import numpy as np
import pytest

from app.analysis.catalogue import Facts, Unreadable
from app.analysis.library import Entry
from app.panels.recordings import (
    LeaveList,
    LookAtList,
    LookFirst,
    OpenNeighbour,
    RecordingsPanel,
    about,
    details,
)
from app.session.choice import Listing
from app.session.commands import OpenRecording
from estimator import Parameters
from recordings import Provenance
from tests.app.fake_recordings import SPEED, fake_opened, fake_recording
from tests.app.fake_session import context, snapshot, status
from tests.app.waiting import until


def test_a_measured_recording_is_described_by_its_size():
    assert about(fake_opened()) == "1 sensor, 40 frames, 2.6 s"
    assert details(fake_opened())[1] == "Fixed frame: world"


def test_a_simulated_recording_says_so_first():
    fake = fake_recording()
    fake.simulated = True
    fake.provenance = Provenance(True, "towards", 0.25, 3, 7, "paper: ...", "tofscope simulate")
    said = about(fake_opened(fake))
    assert said == "Simulated: towards, 0.25 m/s, trial 3 · 1 sensor, 40 frames, 2.6 s"
    fake.simulated = False
    fake.provenance = replace(fake.provenance, simulated=False)
    assert "imulated" not in about(fake_opened(fake))


def test_what_is_being_opened_is_said_and_what_stays_open_after_a_bad_one(client):
    panel = RecordingsPanel(context(client))
    assert "Opening …" in client.text()
    panel.announce(status(opening="a<b"))
    assert "Opening a&lt;b …" in client.text()
    assert client.called("opening.show") == [["a<b"]]
    opened = fake_opened()
    panel.announce(status(opened=opened))
    assert f"Opening {opened.entry.label} …" in client.text()  # until its first frame is drawn
    assert client.called("opening.end") == []
    panel.show(snapshot(opened=opened))
    panel.show(snapshot(opened=opened))
    assert "Opening" not in client.text()
    assert client.called("opening.end") == [[]]  # once
    panel.announce(status(opening="bad", opened=opened))
    assert "Opening bad …" in client.text()
    assert client.called("opening.show")[-1] == ["bad"]
    panel.announce(status(opened=opened))
    assert "1 sensor, 40 frames" in client.text()
    assert len(client.called("opening.end")) == 2
    panel.announce(status(opening="bad"))
    panel.announce(status())
    assert "No recording is open." in client.text()
    assert client.called("opening.nothing") == [
        ["No recording is open. Choose one from the list: key O."]
    ]


def test_one_frame_is_one_frame():
    single = fake_recording()
    single.stamps = single.stamps[:1]
    assert about(fake_opened(single)) == "1 sensor, 1 frame, 0.0 s"


def test_notes_stand_beside_the_name_and_are_whole(client):
    panel, fake = RecordingsPanel(context(client)), fake_recording()
    panel.show(snapshot(opened=fake_opened(fake)))
    assert "note" not in client.text()
    fake.warnings = (f"The mesh {'folder/' * 40}<b>.dae is not there.",)
    fake.duplicates, fake.has_truth = 3, False
    panel.show(snapshot(opened=fake_opened(fake)))  # some come with further frames
    assert ">3 notes<" in client.text()
    expected = [
        *fake.warnings,
        "3 duplicate readings are left out.",
        "The recording has no truth, so there is nothing to compare with.",
    ]
    assert client.called("notes.fill")[-1] == ["fake", expected]
    panel.show(snapshot(opened=fake_opened()))
    assert "note" not in client.text()


def test_the_assumption_behind_a_truth_frame_is_a_note(client):
    fake = fake_recording()
    fake.truth_frame = "torso"
    RecordingsPanel(context(client)).show(snapshot(opened=fake_opened(fake)))
    [(_, [note])] = client.called("notes.fill")
    assert note.startswith("Coverage, precision, ")
    assert note.endswith("every point moves with torso.")


def test_a_recording_says_where_no_pair_counts_with_this_n(client):
    fake = fake_recording()
    fake.truth = lambda k: SPEED if 5 <= k < 10 else np.zeros(3)
    panel, opened = RecordingsPanel(context(client)), fake_opened(fake)
    for n, said in ((4, False), (5, True), (4, False)):
        panel.show(snapshot(opened=opened, parameters=Parameters(n=n)))
        notes = client.shown("notes.fill")
        assert bool(notes and notes[1]) == said
        if said:
            assert notes[1][0].startswith("The recording has no pair that counts: ")
            assert notes[1][0].endswith(f"n is {n}.")


def test_the_list_is_filled_once_it_is_looked_at_and_then_with_what_is_new(client):
    panel = RecordingsPanel(context(client))
    a, b = fake_opened().entry, Entry("dir/b", fake_opened().entry.path)
    facts = Facts(simulated=False, scenario="", seconds=2.6, frames=40, sensors=1, truth=True)
    panel.announce(status(listing=Listing((a, b)), opened=fake_opened()))
    assert client.called("recordings.fill") == []
    listing = Listing((a, b), {"fake": facts}, looks=1)
    panel.announce(status(listing=listing, opened=fake_opened()))
    assert client.called("recordings.fill") == [[["fake", "dir/b"], "fake"]]
    listing = replace(listing, about={"fake": facts, "dir/b": Unreadable("b is bad.")})
    panel.announce(status(listing=listing, opened=fake_opened()))
    panel.announce(status(listing=listing, opened=fake_opened()))
    told = asdict(facts)
    assert client.called("recordings.describe") == [
        [{"fake": told}],
        [{"dir/b": {"reason": "b is bad."}}],
    ]
    assert client.called("recordings.show") == []
    panel.announce(status(listing=replace(listing, looks=2, shown=1)))
    assert client.called("recordings.fill")[-1] == [["fake", "dir/b"], None]
    assert client.called("recordings.show") == [[]]


def test_what_a_person_does_with_the_list_is_posted(client):
    posted = []
    RecordingsPanel(context(client, posted.append))
    client.tell("recordings.look", {})
    client.tell("recordings.seen", {"rows": [3, 4]})
    client.tell("recordings.choose", {"label": "b"})
    client.tell("recordings.choose", {"label": 3})
    client.tell("recordings.close", {})
    client.tell("recordings.step", {"steps": -(10**9)})
    for command in ("Choose a recording", "Next recording", "Previous recording"):
        client.trigger(command)
    until(lambda: len(posted) == 8)
    assert posted == [
        LookAtList(),
        LookFirst((3, 4)),
        OpenRecording("b"),
        LeaveList(),
        OpenNeighbour(-1),
        LookAtList(show=True),
        OpenNeighbour(1),
        OpenNeighbour(-1),
    ]


def test_steps_add_up():
    assert OpenNeighbour(1).merged_with(OpenNeighbour(1)) == OpenNeighbour(2)
    OpenNeighbour(1).merged_with(OpenNeighbour(-1)).apply(None)  # type: ignore[arg-type]


@pytest.mark.parametrize("name", ['a"b', "<img onerror=x>"])
def test_names_are_text(client, name):
    RecordingsPanel(context(client)).show(snapshot(opened=fake_opened(fake_recording(name=name))))
    assert client.recording() == name
    assert "<img" not in client.text()
