"""Controls of parameters and presets in a session."""

import json
import time

import pytest

from app.analysis.estimates import Estimates
from app.analysis.library import Library
from app.panels.presets import OpenParameters
from app.server.session import Session, Shared
from app.session.presets import Presets, preset_folder
from app.session.reload import Reloads
from estimator import Parameters
from tests.app.fake_recordings import fake_recording
from tests.app.waiting import until


@pytest.fixture
def session(client, tmp_path):
    (tmp_path / "a.mcap").touch()
    library = Library([tmp_path], lambda path: fake_recording(name=path.stem))
    session = Session(client, Shared(library, Estimates(), Reloads(), Parameters()))
    until(lambda: "Moving" in client.text())
    yield session
    session.close()
    session.join(10)


def shows(client, label, value):
    return lambda: client.control(label).value == value


def change(client, label, value):
    """Change a parameter, and wait until it is taken."""
    client.change(label, value)
    time.sleep(0.2)


def test_undo_and_redo(session, client):
    change(client, "δ", 0.3)
    change(client, "n", 4)
    client.trigger("Undo parameters")
    until(shows(client, "n", 8))
    assert client.control("δ").value == 0.3
    client.change("History", "undo")
    until(shows(client, "δ", 0.04))
    client.trigger("Redo parameters")
    client.trigger("Redo parameters")
    until(shows(client, "n", 4))
    until(shows(client, "δ", 0.3))


def test_one_parameter_is_reset_and_the_others_stay(session, client):
    change(client, "δ", 0.3)
    change(client, "n", 4)
    client.change("Reset", "δ")
    until(shows(client, "δ", 0.04))
    assert client.control("n").value == 4
    client.trigger("Undo parameters")
    until(shows(client, "δ", 0.3))


def test_a_preset_is_saved_loaded_and_deleted(session, client):
    change(client, "δ", 0.3)
    client.change("Name", "loose ")
    client.press_group("Save")
    until(shows(client, "Preset", "loose"))
    change(client, "δ", 0.1)
    client.press_group("Load")
    until(shows(client, "δ", 0.3))
    until(shows(client, "Name", "loose"))
    client.change("Name", "tight")
    client.press_group("Rename")
    until(shows(client, "Preset", "tight"))
    assert Presets(preset_folder()).load("tight") == Parameters(delta=0.3)
    client.press_group("Delete")
    until(lambda: any("Press Delete once more" in n for n in client.notifications))
    assert Presets(preset_folder()).names() == ["tight"]
    client.press_group("Delete")
    until(shows(client, "Preset", "(none saved yet)"))


def test_a_preset_that_another_saved_is_listed_and_one_that_is_replaced_is_told(session, client):
    Presets(preset_folder()).save("theirs", Parameters(n=3))

    def listed():
        client.tell("step", {"frames": 1})  # any change redraws the page
        time.sleep(0.3)
        return "theirs" in client.control("Preset").options

    until(listed)
    change(client, "δ", 0.3)
    client.change("Name", "theirs")
    client.press_group("Save")
    until(lambda: any("theirs already. Press Save once more" in n for n in client.notifications))
    assert Presets(preset_folder()).load("theirs") == Parameters(n=3)
    client.press_group("Save")
    until(lambda: any("theirs holds these parameters now." in n for n in client.notifications))
    assert Presets(preset_folder()).load("theirs") == Parameters(delta=0.3)
    Presets(preset_folder()).delete("theirs")
    client.press_group("Load")
    until(lambda: any("There is no file" in n for n in client.notifications))
    until(shows(client, "Preset", "(none saved yet)"))


def test_a_new_preset_is_no_replaced_one_and_one_without_a_name_is_none(session, client):
    client.press_group("Save")
    until(lambda: any("Type a name first" in n for n in client.notifications))
    client.change("Name", "mine")
    client.press_group("Save")
    until(shows(client, "Preset", "mine"))
    until(lambda: "mine holds these parameters now." in client.notifications)
    assert not any("There is a preset" in n for n in client.notifications)


def test_fields_correct_in_words_what_is_out_of_range_and_are_reset_together(session, client, runs):
    for label, value, said in (
        ("min cluster size", 1, "min cluster size goes from 2 to 100000 points: 1 became 2."),
        ("min samples (0 = unset)", -1, "min samples goes from 0 to 100000 points: -1 became 0."),
        ("max range [m]", -2.0, "max range goes from 1e-06 to 1000 m: -2 became 1e-06."),
    ):
        client.change(label, value)
        until(lambda said=said: (client.shown("fields.say") or [""])[-1] == said)
    assert Parameters(min_cluster_size=2) in runs.parameters
    until(lambda: runs.parameters[-1].max_range == 1e-6)
    change(client, "δ", 0.3)
    change(client, "min cluster size", 30)
    change(client, "allow single cluster", True)
    client.change("Reset", "others")
    until(shows(client, "min cluster size", 20))
    until(shows(client, "max range [m]", 4.0))
    until(lambda: client.shown("fields.say")[-1] == "")
    until(lambda: not client.control("allow single cluster").value)
    assert client.control("δ").value == 0.3


def test_a_bad_name_is_told_and_the_session_goes_on(session, client):
    client.change("Name", "../../evil")
    client.press_group("Save")
    until(lambda: any("A preset's name is made of" in n for n in client.notifications))
    change(client, "δ", 0.3)
    client.trigger("Undo parameters")
    until(shows(client, "δ", 0.04))


def test_a_file_is_opened_also_beyond_the_sliders(session, client):
    session._queue.post(OpenParameters("p.json", json.dumps({"n_min": 900, "n": 3}).encode()))
    until(shows(client, "N_min", 900))
    assert client.control("N_min").max == 900
    assert client.control("n").value == 3
    client.trigger("Undo parameters")
    until(shows(client, "N_min", 60))
    until(lambda: client.control("N_min").max == 200)


@pytest.mark.parametrize(
    ("content", "sentence"),
    [
        (b"{", "p.json is not JSON"),
        (b'{"gamma": 7}', "gamma must be between 0 and 1"),
        (b"\xff\xfe", "p.json is not a text file"),
        (b" " * 200_000, "p.json is too large"),
    ],
)
def test_a_file_that_cannot_be_used_is_told(session, client, content, sentence):
    session._queue.post(OpenParameters("p.json", content))
    until(lambda: any(sentence in n for n in client.notifications))
    assert client.control("γ").value == 0.7
