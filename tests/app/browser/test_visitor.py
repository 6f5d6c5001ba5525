"""What a client's messages are let do."""

import logging
from dataclasses import replace

import pytest
from viser import _messages as messages

from app.browser.connections import Unreadable
from app.browser.rubbish import RubbishLog
from app.browser.uploads import LARGEST_UPLOAD
from app.browser.visitor import Visitor
from tests.app.wire_client import camera_at

CAMERA = camera_at((1.0, 2.0, 3.0))
CLICK = messages.ScenePointerMessage("click", (0.0, 0.0, 0.0), (0.0, 1.0, 0.0), ((0.5, 0.5),), None)
NAN, INF = float("nan"), float("inf")


def updates(value, name="value"):
    return messages.GuiUpdateMessage("u", {name: value})


def stored(value, error=None):
    return messages.LocalStorageGetItemResponseMessage(value, error, "r")


@pytest.fixture
def ended():
    return []


@pytest.fixture
def visitor(client, ended):
    return Visitor(lambda: client, lambda: ended.append(True), RubbishLog())


def misunderstood(visitor, caplog) -> int:
    caplog.set_level(logging.WARNING, "app.browser.rubbish")
    visitor.leave()
    lines = [r.getMessage() for r in caplog.records if r.name == "app.browser.rubbish"]
    return int(lines[-1].split()[3].replace(",", "")) if lines else 0


@pytest.mark.parametrize(
    "message",
    [
        CAMERA,
        replace(CAMERA, image_height=0, image_width=0),
        CLICK,
        updates(3),
        updates(0.5),
        updates(True),
        updates("x" * 10_000),
        updates([2, 5]),
        messages.CommandTriggerMessage("u"),
        messages.GetRenderResponseMessage(b"", "r"),
        stored(None),
        stored("text"),
        stored(None, "blocked"),
    ],
)
def test_what_a_page_sends_is_handled(visitor, caplog, message):
    assert visitor.admits(message)
    assert misunderstood(visitor, caplog) == 0


@pytest.mark.parametrize(
    "message",
    [
        Unreadable(ValueError("no MessagePack")),
        replace(CAMERA, position=(NAN, 0.0, 0.0)),
        replace(CAMERA, look_at=(1e300, 0.0, 0.0)),
        replace(CAMERA, wxyz=(1.0, 0.0, 0.0)),
        replace(CAMERA, up_direction=5),
        replace(CAMERA, position=("1", "2", "3")),
        replace(CAMERA, fov=0.0),
        replace(CAMERA, fov=INF),
        replace(CAMERA, image_width=10**9),
        replace(CLICK, ray_origin=None),
        replace(CLICK, ray_direction=(NAN, 0.0, 0.0)),
        replace(CLICK, ray_direction=(0.0, 1e-300, 0.0)),
        replace(CLICK, event_type="rect-select"),
        updates(NAN),
        updates(INF),
        updates((1, NAN)),
        updates([[1], [2]]),
        updates("x" * 10_001),
        updates(3, "update_cb"),
        messages.GuiUpdateMessage("u", {}),
        messages.GuiUpdateMessage("u", {"value": 1, "visible": False}),
        messages.GuiUpdateMessage("u", 5),  # type: ignore[arg-type]
        stored(5),
        stored("a", 5),
        messages.GetRenderResponseMessage("text", "r"),  # type: ignore[arg-type]
        messages.FileTransferStartUpload("no button", "t", "a.json", "", 1, 10),
        messages.FileTransferPart("b", "t", 0, b"never announced"),
    ],
)
def test_what_no_page_sends_is_left_out_and_counted(visitor, caplog, message):
    assert not visitor.admits(message)
    assert misunderstood(visitor, caplog) == 1


@pytest.mark.parametrize(
    "message",
    [
        messages.ShareUrlRequest(),
        messages.GuiFormDirtyMessage("u"),
        messages.GuiButtonHoldMessage("u", 1.0),
        messages.RunJavascriptMessage("alert(1)"),
    ],
)
def test_what_this_app_has_no_use_for_is_left_out(visitor, caplog, message):
    assert not visitor.admits(message)
    assert misunderstood(visitor, caplog) == 0


def test_a_client_of_too_much_rubbish_is_cut_off_once(visitor, ended, caplog):
    for _ in range(99):
        visitor.failed(KeyError("x"))
        assert visitor.admits(CAMERA)
    assert not ended
    for _ in range(900):
        visitor.admits(Unreadable(ValueError()))
    assert ended == [True]
    assert not visitor.admits(CAMERA)
    assert misunderstood(visitor, caplog) == 100


def test_a_file_that_is_too_large_is_told_in_a_sentence(visitor, client, caplog):
    source = client.gui.add_upload_button("up")._impl.uuid
    start = messages.FileTransferStartUpload(source, "t", "big.json", "", 954, 500_000_000)
    client.take_sent()
    assert not visitor.admits(start)
    assert client.notifications == [
        "big.json has 500,000,000 bytes, but not more than 1,000,000 can be uploaded at a time; "
        "choose a smaller file."
    ]
    assert len(client.take_sent()) == 2  # the page ends it
    for k in range(954):
        assert not visitor.admits(messages.FileTransferPart(source, "t", k, bytes(9)))
    fits = messages.FileTransferStartUpload(source, "s", "a.json", "", 1, LARGEST_UPLOAD)
    assert visitor.admits(fits)
    assert visitor.admits(messages.FileTransferPart(source, "s", 0, b"{}"))
    assert misunderstood(visitor, caplog) == 0
