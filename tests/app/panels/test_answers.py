"""What is known of a zone in words, and when it is sent to the page."""

from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from app.analysis.answers import answer
from app.analysis.zones import SOURCE, TARGET, ZoneState, zone_of_point
from app.panels.answer_rows import read_at, rows, title
from app.panels.answers import AnswersPanel, LetGo, LookAt, LookFromSensor
from app.scene.colours import css
from app.scene.settings import ViewSettings
from app.session.inspection import Inspected
from tests.app.fake_session import context, snapshot
from tests.app.panels.test_sensors import calls

PALETTE = ViewSettings().palette
SHOWN = snapshot()


def asked(side, index) -> Any:
    pair = SHOWN.pair
    assert pair is not None
    found = answer(SHOWN.opened.recording, pair, zone_of_point(pair, side, index), 4.0)
    assert found is not None
    return found


def said(found) -> dict[str, str]:
    return {name: value for name, value, *_ in rows(found, PALETTE)}


def test_a_moving_point_says_all_that_is_known():
    found = asked(SOURCE, 450)
    x, y, z = found.point.position
    words = said(found)
    assert title(found) == "front, row 18, column 0"
    assert words["Frame"] == "12 (source)"
    assert words["Distance"].startswith("1.000 m, 1.")
    assert words["Read"] == "at the frame's stamp"
    assert words["Position"] == f"{x:.3f}, {y:.3f}, {z:.3f} m".replace("-", "−")
    assert words["Label"] == "moving"
    assert words["Velocity"].startswith("0.1")
    assert words["True velocity"] == "0.150 m/s (0.00, 0.15, 0.00)"
    assert words["Error"] == f"{found.point.error:.3f} m/s"
    assert ("Label", "moving", css(PALETTE.source)) in rows(found, PALETTE)


def test_a_point_that_was_missed_says_so_and_one_at_rest_is_at_rest():
    assert said(asked(SOURCE, 5))["True velocity"] == "at rest"
    moving = asked(SOURCE, 450)
    missed = replace(
        moving, point=replace(moving.point, velocity=None, label=asked(SOURCE, 5).point.label)
    )
    assert said(missed)["Error"] == "it moves and has no velocity"
    assert "Error" not in said(asked(TARGET, 450))
    assert "Cluster's mean" in said(asked(TARGET, 450))


def test_a_zone_without_a_point_says_why():
    found = replace(asked(TARGET, 5), point=None, along_axis=np.nan, state=ZoneState.REFUSED)
    words = said(replace(found, status=4))
    assert words["No point"] == "refused by its status"
    assert words["Status"] == "4: target not consistent"
    assert "Distance" not in words
    assert said(replace(found, status=77))["Status"] == "77: unknown"


@pytest.mark.parametrize(
    ("lateness", "words"),
    [
        (0.0, "at the frame's stamp"),
        (0.012, "12 ms after the frame's stamp"),
        (-0.067, "not in this frame, last 67 ms before"),
        (np.nan, "not yet in this recording"),
    ],
)
def test_when_a_sensor_was_read_is_said_in_words(lateness, words):
    assert read_at(lateness) == words


def test_answers_are_sent_where_they_change(client):
    panel, found = AnswersPanel(context(client)), asked(SOURCE, 450)
    pinned = replace(SHOWN, inspected=Inspected(pinned=found))
    panel.show(pinned)
    panel.show(pinned)
    (sent,) = calls(client, r"answers\.pin")
    assert sent["title"] == title(found)
    panel.show(replace(SHOWN, inspected=Inspected(pointed_sensor=0)))
    assert [c["title"] for c in calls(client, r"answers\.point")] == ["Sensor front"]


def test_what_the_pointer_is_on_is_posted(client):
    posted: list = []
    AnswersPanel(context(client, posted.append))
    client.tell("pointed", {"ray": {"origin": [0, 1, 2], "direction": [0, 0, 1]}})
    client.tell("pointed", {"zone": {"sensor": 0, "row": 1, "column": 2}})
    client.tell("pointed", {})
    client.tell("let_go", {})
    client.tell("look_from_sensor", {})
    looks = [command.pointed for command in posted[:3]]
    assert [type(command) for command in posted] == [LookAt] * 3 + [LetGo, LookFromSensor]
    assert looks[0].ray.origin == (0.0, 1.0, 2.0)
    assert looks[1].zone.column == 2
    assert (looks[2].ray, looks[2].zone) == (None, None)
