"""A session that compares two sets of parameters."""

import io
import time

import numpy as np
from PIL import Image

from app.analysis.parameter_files import from_text
from app.scene.arrows import linear
from app.scene.palettes import PAPER, palette
from app.scene.scene_root import FIXED
from estimator import Parameters
from tests.app.drawn import arrow_count, points
from tests.app.waiting import until


def test_b_is_edited_apart_from_a_and_both_can_be_drawn(session, client, runs):
    client.press("Copy A to B")
    until(lambda: "<b>B</b> is shown" in client.text())
    client.change("δ", 0.3)
    until(lambda: arrow_count(client) == 0)
    client.trigger("Compare: switch between A and B")
    until(lambda: arrow_count(client) == 100)
    until(lambda: client.control("δ").value == 0.04)
    client.change("γ", 0.6)
    until(lambda: runs.parameters[-1] == Parameters(gamma=0.6))
    client.press("Switch to B")
    until(lambda: client.control("δ").value == 0.3)
    until(lambda: client.control("γ").value == 0.7)
    until(lambda: arrow_count(client) == 0)
    client.press("Draw both")
    # Points and labels are those of the edited one, and each keeps its colour.
    until(lambda: len(points(client, "second_flow")) == 100)
    assert arrow_count(client) == 0
    client.change("δ", 0.05)
    until(lambda: arrow_count(client) == 100)
    colours = palette(PAPER, dark=False)
    for node, colour in (("flow", colours.second), ("second_flow", colours.flow)):
        drawn = client.node(f"{FIXED}/{node}").colors
        assert (drawn == linear(np.array(colour))).all()
    client.press("Save screenshot")
    until(lambda: client.downloads)
    said = Image.open(io.BytesIO(client.downloads[0][1])).info
    assert from_text(said["Parameters of A"], "A") == Parameters(gamma=0.6)
    assert from_text(said["Parameters of B"], "B") == Parameters(delta=0.05)
    assert from_text(said["Parameters"], "") == Parameters(delta=0.05)
    client.change("Flow", False)
    until(lambda: not client.node(f"{FIXED}/second_flow").visible)
    client.press("Remove B")
    until(lambda: len(points(client, "second_flow")) == 0)
    until(lambda: client.control("γ").value == 0.6)
    until(lambda: client.control("δ").value == 0.04)


def test_a_and_b_are_undone_apart(session, client):
    client.change("γ", 0.6)
    client.press("Copy A to B")
    until(lambda: "<b>B</b> is shown" in client.text())
    client.change("δ", 0.3)
    until(lambda: arrow_count(client) == 0)
    client.trigger("Undo parameters")
    until(lambda: client.control("δ").value == 0.04)
    client.trigger("Undo parameters")
    client.press("Switch to A")
    until(lambda: "<b>A</b> is shown" in client.text())
    assert client.control("γ").value == 0.6
    client.trigger("Undo parameters")
    until(lambda: client.control("γ").value == 0.7)


def test_a_second_copy_to_b_is_undone_as_any_change_of_b(session, client):
    client.press("Copy A to B")
    until(lambda: "<b>B</b> is shown" in client.text())
    for value in (0.1, 0.2):
        client.change("δ", value)
        until(lambda value=value: f"δ: 0.04 → {value}" in client.text())
        client.tell("step", {"frames": 1})
        time.sleep(1.1)  # two drags
    client.press("Copy A to B")
    until(lambda: client.control("δ").value == 0.04)
    for value in (0.2, 0.1, 0.04):
        client.trigger("Undo parameters")
        until(lambda value=value: client.control("δ").value == value, timeout=5)


def test_only_what_is_shown_is_estimated_at_once(session, client, runs, shared, monkeypatch):
    monkeypatch.setattr(shared.surveys, "request", lambda *_: None)  # nothing in the background
    client.press("Copy A to B")
    until(lambda: "<b>B</b> is shown" in client.text())
    client.change("δ", 0.3)
    until(lambda: runs.parameters[-1].delta == 0.3)
    client.trigger("Compare: switch between A and B")
    until(lambda: client.control("δ").value == 0.04)
    count = len(runs)
    for step in range(3):
        client.tell("seek", {"frame": 30 + step})
        until(lambda step=step: len(runs) == count + step + 1)
    assert [p.delta for p in runs.parameters[count:]] == [0.04] * 3
    until(lambda: "B is not estimated here" in client.text())
    client.press("Draw both")
    until(lambda: runs.parameters[-1].delta == 0.3)
    until(lambda: "not estimated here" not in client.text())


def test_an_error_of_one_estimate_is_told_and_the_other_is_shown(session, client, runs):
    client.press("Copy A to B")
    until(lambda: "<b>B</b> is shown" in client.text())
    client.press("Draw both")
    until(lambda: "The flow of B, over that of A." in client.text())
    runs.error = RuntimeError("B has had enough")
    client.change("δ", 0.05)
    until(lambda: any("B has had enough" in n for n in client.notifications))
    assert len(points(client, "second_flow")) == 100
    assert arrow_count(client) == 0
