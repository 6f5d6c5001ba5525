"""The panel of the sensors' images, and what a person does with it."""

import json
import re
from typing import Any

import pytest

from app.analysis.answers import answer
from app.analysis.zones import SOURCE, TARGET, Zone
from app.panels.answers import LookFromSensor, ZonePlace
from app.panels.sensors import ChangeImages, PinZone, SelectSensor, SensorsPanel
from app.session.inspection import BY_LABEL, ImageSettings, Inspected
from tests.app.fake_session import context, snapshot
from tests.app.waiting import until

SEEN = Inspected(images=ImageSettings(seen=True))


def calls(client, function: str) -> list:
    """Arguments of the calls of a function in the page since the last time."""
    scripts = [message.source for message in client.take_sent() if hasattr(message, "source")]
    found = [re.fullmatch(rf"window\.tofscope\.{function}\((.*)\);", s, re.S) for s in scripts]
    return [json.loads(match[1]) for match in found if match]


@pytest.fixture
def posted() -> list:
    return []


@pytest.fixture
def panel(client, posted) -> SensorsPanel:
    return SensorsPanel(context(client, posted.append))


def test_images_are_sent_once_a_frame_and_only_while_they_are_seen(client, panel):
    shown = snapshot()
    panel.open(shown.opened)
    panel.show(shown)
    assert calls(client, r"sensors\.show") == []
    seen = snapshot(opened=shown.opened, pair=shown.pair, inspected=SEEN)
    panel.show(seen)
    panel.show(seen)
    (sent,) = calls(client, r"sensors\.show")
    assert sent["title"] == "Frame 20 (target)"
    panel.show(shown)
    panel.show(seen)
    assert len(calls(client, r"sensors\.show")) == 1


def test_a_single_sensor_is_enlarged(client, panel):
    panel.show(snapshot(inspected=SEEN))
    (sent,) = calls(client, r"sensors\.show")
    assert sent["selected"]["sensor"] == 0


def test_a_frame_without_a_source_says_so(client, panel):
    images = ImageSettings(side=SOURCE, seen=True)
    panel.show(snapshot(frame=2, inspected=Inspected(images=images)))
    assert calls(client, r"sensors\.say") == ["There is no frame k − n this early."]


def test_what_a_person_does_is_posted(client, panel, posted):
    client.tell("images_seen", {"seen": True})
    client.tell("sensor_clicked", {"sensor": 3})
    client.tell("zone_clicked", {"sensor": 0, "row": 1, "column": 2})
    client.change("Colour", BY_LABEL)
    client.change("Images of", client.control("Images of").options[1])
    client.press("From this sensor")
    assert posted == [
        ChangeImages({"seen": True}),
        SelectSensor(3),
        PinZone(ZonePlace(sensor=0, row=1, column=2)),
        ChangeImages({"colours": BY_LABEL}),
        ChangeImages({"side": SOURCE}),
        LookFromSensor(),
    ]
    later = ChangeImages({"side": TARGET})
    merged = later.merged_with(ChangeImages({"side": SOURCE, "seen": True}))
    assert merged.values == {"side": TARGET, "seen": True}


def test_the_session_selects_pins_and_lets_go(client, session):
    def told(kind, data, expected):
        client.take_sent()
        client.tell(kind, data)
        until_marks(client, expected)

    client.tell("images_seen", {"seen": True})
    told("sensor_clicked", {"sensor": 0}, {"selected": 0, "pinned": None})
    told("sensor_clicked", {"sensor": 0}, {"selected": None, "pinned": None})
    told("zone_clicked", {"sensor": 0, "row": 1, "column": 2}, {"selected": 0, "pinned": [0, 1, 2]})
    told("let_go", {}, {"selected": None, "pinned": None})
    told("pointed", {"zone": {"sensor": 0, "row": 3, "column": 4}}, {"pointed": [0, 3, 4]})
    told("pointed", {}, {"pointed": None})
    # Nothing that a browser names wrongly does any harm.
    client.tell("zone_clicked", {"sensor": 99, "row": -1, "column": 2})
    client.tell("sensor_clicked", {"sensor": -1})
    client.tell("pointed", {"ray": {"origin": [0, 0, 0], "direction": [0, 0, 0]}})
    client.tell("pointed", {"ray": {"origin": [0, 0, 1e300], "direction": [0, 0, 1]}})
    told("pointed", {"zone": {"sensor": 0, "row": 3, "column": 5}}, {"pointed": [0, 3, 5]})


def until_marks(client, expected: dict) -> None:
    seen: list = []

    def arrived() -> bool:
        seen.extend(calls(client, r"sensors\.mark"))
        return bool(seen) and expected.items() <= seen[-1].items()

    until(arrived)


def test_zones_of_the_other_cloud_are_not_marked(client, panel):
    shown: Any = snapshot()
    found = answer(shown.opened.recording, shown.pair, Zone(SOURCE, 0, 1, 2), 4.0)
    cases: Any = ((TARGET, None), (SOURCE, [0, 1, 2]))
    for side, expected in cases:
        images = ImageSettings(side=side, seen=True)
        client.take_sent()
        panel.show(snapshot(inspected=Inspected(pinned=found, images=images)))
        (marks,) = calls(client, r"sensors\.mark")
        assert marks["pinned"] == expected
