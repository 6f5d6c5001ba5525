"""Canaries: each says in words what an upgrade of viser or websockets has changed."""

import inspect
import logging
import warnings

import msgspec
import pytest
import viser
import viser._messages
import viser.infra
import viser.infra._infra
import websockets.asyncio.server as websocket_server

from app.browser import connections
from app.browser.guarded_server import GuardedServer
from tests.app.browser.viser_page import scripts_and_styles

CONNECTIONS = "app/browser/connections.py"


def parts(source: object, *wanted: str, why: str) -> None:
    """Fail with a sentence where some source has not one of these parts any more."""
    missing = [part for part in wanted if part not in inspect.getsource(source)]  # type: ignore[arg-type]
    assert not missing, f"viser or websockets has no {missing} any more; {why} ({CONNECTIONS})."


def test_viser_serves_with_what_is_guarded():
    parts(viser.ViserServer, "infra.WebsockServer(", "message_class=", why="nothing is guarded")
    parts(
        viser.infra.WebsockServer,
        *("websockets.asyncio.server.serve(", "ws_handler,", "process_request="),
        why="foreign pages are let in",
    )
    before = websocket_server.serve, viser.infra.WebsockServer
    with connections.guarding(connections.Guards(lambda _: None, {}, lambda *_: None)):  # type: ignore[arg-type, return-value]
        assert websocket_server.serve is not before[0]
        assert viser.infra.WebsockServer is not before[1]
    assert (websocket_server.serve, viser.infra.WebsockServer) == before


def test_what_is_guarded_is_not_what_viser_sets_itself():
    source = inspect.getsource(viser.infra.WebsockServer)
    for option in ("process_response", "create_connection", "max_queue"):
        assert option not in source, f"viser sets {option} now: merge it in {CONNECTIONS}"


def test_messages_pass_the_attendant():
    parts(
        viser.infra.WebsockServer,
        "client_connection._handle_incoming_message(client_id, message)",
        "self._live_connections[client_id] = connection",
        "for cb in self._client_connect_cb:",
        "for cb in self._client_disconnect_cb:",
        why="clients' messages are not looked at",
    )
    parts(
        viser.infra._infra._message_consumer,
        "await websocket.recv()",
        "message_class.deserialize(raw)",
        why="messages are neither slowed down nor decoded without failing",
    )


def test_messages_are_made_encodable_when_they_are_sent():
    parts(
        viser.infra._infra._message_producer,
        "buffer.window_generator(",
        "await window_generator.__anext__()",
        "message.as_serializable_dict(binary_buffers)",
        why="text with a lone surrogate ends a connection",
    )


def test_a_client_with_another_version_is_told_by_code_1002():
    parts(viser.infra.WebsockServer, 'startswith("viser-v")', "1002", why="old pages wait for ever")


def test_all_that_a_page_sends_is_of_known_kinds():
    source = scripts_and_styles()
    for name in connections.__all__:
        assert f"type:`{name}`" in source, f"viser's page sends no {name} any more ({CONNECTIONS})"


def test_uploads_are_to_buttons_and_end_by_their_last_byte(client):
    button = client.gui.add_upload_button("up")
    number = client.gui.add_number("k", 1.0)
    assert connections.accepts_files(client, button._impl.uuid)
    assert not connections.accepts_files(client, number._impl.uuid)
    assert not connections.accepts_files(client, "nothing")
    client.take_sent()
    start = viser._messages.FileTransferStartUpload(button._impl.uuid, "t", "a", "b", 3, 900)
    connections.end_upload(client, start)
    acknowledged, removed = client.take_sent()
    assert (acknowledged.transferred_bytes, acknowledged.total_bytes) == (900, 900)
    assert removed.uuid == "upload-t"
    page = scripts_and_styles()
    for part in ("=`upload-`+", "case`RemoveNotificationMessage`", "case`FileTransferPartAck`"):
        assert part in page, f"a refused upload goes on in the page (end_upload of {CONNECTIONS})"


def test_viser_keeps_what_is_uploaded_as_it_is_counted():
    parts(
        viser.GuiApi._handle_file_transfer_part,
        'message.part_index in state["parts"]',
        "0 <= message.part_index < part_count",
        'if len(state["parts"]) < part_count:',
        why="app/browser/uploads.py counts otherwise, and the memory is not bounded",
    )


def test_what_msgspec_cannot_encode_is_known():
    for bad in ("\ud800", 2**64, -(2**63) - 1):
        with pytest.raises((UnicodeEncodeError, OverflowError)):
            msgspec.msgpack.encode(bad)
    for fine in ("ä\U0001f600", 2**64 - 1, -(2**63), float("nan")):
        msgspec.msgpack.encode(fine)


def test_the_logger_of_connections_is_that_of_websockets():
    source = inspect.getsource(websocket_server)
    assert f'"{connections.CONNECTION_LOGGER}"' in source, (
        f"websockets logs elsewhere: set CONNECTION_LOGGER of {CONNECTIONS}, or connections that "
        "ask for nothing are complained of on the terminal"
    )
    GuardedServer("127.0.0.1", 0).stop()
    assert not logging.getLogger(connections.CONNECTION_LOGGER).isEnabledFor(logging.ERROR)


def test_a_message_to_a_client_that_has_gone_is_warned_of_in_these_words(client):
    buffer = client.server._websock_server._broadcast_buffer
    buffer.set_done()
    # Other words are to be set as CLOSED_CONNECTION, or they come up on the terminal.
    with pytest.warns(UserWarning, match=connections.CLOSED_CONNECTION):
        buffer.push(viser._messages.RunJavascriptMessage(source="1 + 1"))


def test_an_odd_message_is_warned_of_in_these_words():
    sent = msgspec.msgpack.encode(
        {"type": "TransformControlsUpdateMessage", "wxyz": [1, "\n"], "position": []}
    )
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        with pytest.raises(TypeError):
            viser._messages.Message.deserialize(sent)
        warnings.filterwarnings("ignore", message=connections.ODD_MESSAGE)
        with pytest.raises(TypeError):
            viser._messages.Message.deserialize(sent)
    assert len(caught) == 2, f"set ODD_MESSAGE of {CONNECTIONS} to {caught}"
    assert "Dropping upload" in inspect.getsource(viser.GuiApi._finish_file_upload)
