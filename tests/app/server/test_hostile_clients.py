"""A server whose clients send whatever they like, while others work."""

import json
import logging
import os
import random

import msgspec
import pytest

from app.analysis.estimates import Estimates
from app.analysis.library import Library
from app.server.server import Server
from app.server.session import Shared
from app.session.reload import Reloads
from estimator import Parameters
from tests.app.fake_recordings import fake_recording
from tests.app.waiting import until
from tests.app.wire_client import WireClient


class Page:
    """Texts that a client has been sent."""

    def __init__(self):
        self.texts, self.listed, self.removed = [], [], []

    def __call__(self, _, message):
        props = message.get("props", {})
        if message["type"] == "NotificationShowMessage":
            self.texts.append(props["body"])
        if "recordings.fill(" in (script := message.get("source", "")):
            self.listed, _ = json.loads(f"[{script.split('fill(')[1].removesuffix(');')}]")
        self.texts.append(str(message.get("updates", {}).get("content", "")))
        self.texts.append(message.get("source", ""))

    def has(self, text):
        return any(text in said for said in self.texts)


@pytest.fixture
def server(tmp_path):
    names = (b"a.mcap", b"\xff\xed\xa0\x80.mcap")
    try:
        for name in names:
            (tmp_path / os.fsdecode(name)).touch()
    except OSError:
        pytest.skip("this file system takes no such names")
    library = Library([tmp_path], lambda path: fake_recording(name=path.stem))
    server = Server(Shared(library, Estimates(), Reloads(), Parameters()), "127.0.0.1", 0)
    yield server
    server.close()


def test_a_recording_whose_name_is_no_text_opens(server):
    page = Page()
    with WireClient(server.address, page) as client:
        until(lambda: page.has("Moving"))
        client.tell("recordings.look", {})
        until(lambda: len(page.listed) == 2)
        (label,) = [listed for listed in page.listed if listed != "a"]
        assert label == r"\xff\xed\xa0\x80"
        page.texts.clear()
        client.tell("recordings.choose", {"label": label})
        until(lambda: page.has("Moving"))
        assert page.has(f'aria-label="Recording: {label}"')


def noise(seed: int, uuids: list[str]) -> list[bytes]:
    """Messages of real kinds with values that nothing sends."""
    draw = random.Random(seed)
    values = [None, True, -1, 2**63, 1e300, float("nan"), "", "x" * 5000, b"", [], [[]], {}, ["a"]]
    kinds = [
        ("GuiUpdateMessage", ("uuid", "updates")),
        ("GuiUpdateMessage", ("uuid", "updates")),
        ("CommandTriggerMessage", ("uuid",)),
        ("ViewerCameraMessage", ("wxyz", "position", "fov", "look_at")),
        ("ScenePointerMessage", ("event_type", "ray_origin", "ray_direction")),
        ("FileTransferStartUpload", ("source_component_uuid", "transfer_uuid", "part_count")),
        ("FileTransferPart", ("source_component_uuid", "transfer_uuid", "part_index", "content")),
        ("GetRenderResponseMessage", ("payload", "render_uuid")),
        ("LocalStorageGetItemResponseMessage", ("value", "error", "request_uuid")),
        ("ShareUrlRequest", ()),
        ("GuiFormSubmitMessage", ("uuid",)),
    ]
    sent = []
    for _ in range(90):
        kind, names = draw.choice(kinds)
        fields = {name: draw.choice(values) for name in names}
        if "uuid" in fields and draw.random() < 0.8:
            fields["uuid"] = draw.choice(uuids)
        if "updates" in fields and draw.random() < 0.9:
            fields["updates"] = {"value": draw.choice(values)}
        sent.append(msgspec.msgpack.encode({"type": kind, **fields}))
    return sent


@pytest.mark.parametrize("seed", range(4))
def test_noise_prints_no_traceback_and_touches_nobody_else(server, caplog, capfd, seed):
    page, hostile = Page(), Page()
    with WireClient(server.address, page) as bystander:
        until(lambda: page.has("Moving"))
        with WireClient(server.address, hostile) as client:
            until(lambda: hostile.has("Moving"))
            # A picture would be waited for, which this client does not make.
            named = [*client._uuids.items(), *client._commands.items()]
            for data in noise(seed, [uuid for label, uuid in named if "Save" not in label]):
                client._socket.send(data)
            client.tell("recordings.choose", {"label": "a"})
            client.tell("seek", {"frame": 30})
            until(lambda: hostile.has("timeline.frame(30)"))  # its session goes on, too
        bystander.tell("seek", {"frame": 29})
        until(lambda: page.has("timeline.frame(29)"))
        assert not page.has("unexpected")
    assert not hostile.has("unexpected")
    assert not [r.getMessage() for r in caplog.records if r.levelno >= logging.ERROR]
    out, err = capfd.readouterr()
    assert "Traceback" not in out + err
