from collections.abc import Iterator
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
from mcap.writer import Writer

from recordings import RecordingError
from recordings.decoding import Decoder, stamp_of
from recordings.errors import MisfitError
from recordings.mcap_file import McapFile
from recordings.stamp_index import MEDIA_TYPE, STAMP_INDEX, pack
from tests.recordings.foreign import ForeignFile, header, image, twist

STAMPS = [5, 1_700_000_000_123_456_789, 1_700_000_000_000_000_000]
HEADER_ONLY = """std_msgs/Header header
================================================================================
MSG: std_msgs/Header
builtin_interfaces/Time stamp
string frame_id
================================================================================
MSG: builtin_interfaces/Time
int32 sec
uint32 nanosec
"""


@pytest.fixture
def file(tmp_path: Path) -> Iterator[McapFile]:
    foreign = ForeignFile()
    for log_time, stamp in enumerate(STAMPS):
        pixels = np.full((8, 8), 100 + log_time, "<u2")
        foreign.add("/eye", "sensor_msgs/msg/Image", image(stamp, "eye", pixels, "16UC1"), log_time)
        velocity = twist(stamp + 1, "world", np.array([0.0, -0.2, 0.1]))
        foreign.add("/target", "geometry_msgs/msg/TwistStamped", velocity, log_time)
    opened = McapFile(foreign.write(tmp_path / "x.mcap"))
    yield opened
    opened.close()


def channels(file: McapFile) -> dict:
    return {channel.topic: channel for channel in file.channels}


def test_fields_are_those_that_were_written(file: McapFile):
    decoder = Decoder(file)
    target, eye = channels(file)["/target"], channels(file)["/eye"]
    assert decoder.can_decode(target)
    linear = decoder.decode(target, 0).twist.linear
    assert (linear.x, linear.y, linear.z) == (0.0, -0.2, 0.1)
    pictures = [np.asarray(m.data).view("<u2") for m in decoder.messages(eye)]
    assert [p[0] for p in pictures] == [100, 101, 102]
    assert [stamp_of(message) for message in decoder.messages(eye)] == STAMPS


def test_header_stamps_are_read_without_an_index(file: McapFile):
    decoder = Decoder(file)
    assert decoder.header_stamps(channels(file)["/eye"]).tolist() == STAMPS
    decoder.read_stamps(file.channels)
    stamps = decoder.header_stamps(channels(file)["/target"])
    assert stamps.tolist() == [stamp + 1 for stamp in STAMPS]


def headers(
    path: Path, payloads: list[bytes], index: dict[str, list[int]] | None = None
) -> McapFile:
    """A file of messages that are a header and nothing else."""
    with path.open("wb") as stream:
        writer = Writer(stream)
        writer.start("ros2")
        schema = writer.register_schema("test_msgs/msg/Only", "ros2msg", HEADER_ONLY.encode())
        channel = writer.register_channel("/only", "cdr", schema)
        for k, payload in enumerate(payloads):
            writer.add_message(channel, k, payload, k)
        if index is not None:
            writer.add_attachment(0, 0, STAMP_INDEX, MEDIA_TYPE, pack(index))
        writer.finish()
    return McapFile(path)


def cdr(sec: int, nanosec: int, order: str) -> bytes:
    encapsulation = b"\x00\x01\x00\x00" if order == "little" else bytes(4)
    body = sec.to_bytes(4, order, signed=True) + nanosec.to_bytes(4, order)  # type: ignore[arg-type]
    return encapsulation + body + (1).to_bytes(4, order) + b"\x00"  # type: ignore[arg-type]


def test_either_order_of_bytes_is_read(tmp_path: Path):
    file = headers(tmp_path / "x.mcap", [cdr(7, 8, "little"), cdr(7, 8, "big")])
    decoder, channel = Decoder(file), file.channels[0]
    assert decoder.header_stamps(channel).tolist() == [7_000_000_008] * 2
    assert [stamp_of(message) for message in decoder.messages(channel)] == [7_000_000_008] * 2
    file.close()


def test_an_index_is_believed_where_some_of_its_stamps_are_those_of_the_headers(tmp_path: Path):
    payloads = [cdr(second, 0, "little") for second in range(5)]
    true = [second * 10**9 for second in range(5)]
    believed = [true[0], 77, true[2], true[3], true[4]]  # the second one is not looked at
    for name, index, found in (
        ("some", believed, believed),
        ("short", true[:-1], true),
        ("constant", [5] * 5, true),
        ("backwards", true[::-1], true),
    ):
        file = headers(tmp_path / f"{name}.mcap", payloads, {"/only": index})
        assert Decoder(file).header_stamps(file.channels[0]).tolist() == found, name
        file.close()


SHORT = b"\x00\x01\x00\x00\x01"


def test_messages_that_are_too_short_for_a_header_are_left_out_and_counted(tmp_path: Path):
    payloads = [SHORT, cdr(1, 0, "little"), SHORT, cdr(2, 0, "little")]
    file = headers(tmp_path / "x.mcap", payloads)
    decoder, channel = Decoder(file), file.channels[0]
    assert decoder.header_stamps(channel).tolist() == [10**9, 2 * 10**9]
    assert [stamp_of(decoder.decode(channel, i)) for i in range(2)] == [10**9, 2 * 10**9]
    assert decoder.left_out.sentences() == [
        "2 messages of /only are left out, first 0: it is too short for a header."
    ]
    decoder.leave_out(channel, 1, "it is one more")
    assert decoder.left_out.sentences()[1] == "Message 3 of /only is left out: it is one more."
    file.close()
    with pytest.raises(RecordingError, match="is closed"):
        file.message(channel, 1)


def test_messages_that_do_not_fit_their_type_are_left_out_and_counted(tmp_path: Path):
    file = headers(tmp_path / "x.mcap", [SHORT, cdr(1, 0, "little"), SHORT])
    decoder, channel = Decoder(file), file.channels[0]
    assert stamp_of(decoder.first(channel)) == 10**9
    for _ in range(2):  # what is read twice is counted once
        assert [stamp_of(message) for message in decoder.messages(channel)] == [10**9]
    assert decoder.readable(channel, 2) is None
    (sentence,) = decoder.left_out.sentences()
    assert sentence.startswith("2 messages of /only are left out, first 0: it does not fit the ty")
    with pytest.raises(MisfitError, match="it does not fit the type test_msgs/msg/Only"):
        decoder.decode(channel, 0)
    file.close()
    with pytest.raises(RecordingError, match=r"is closed\.$"):
        decoder.readable(channel, 1)


def test_a_message_that_is_too_large_to_decode_is_left_out(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
):
    monkeypatch.setattr("recordings.decoding._MOST_BYTES_OF_OTHERS", 11)
    file = headers(tmp_path / "x.mcap", [cdr(1, 0, "little")])
    decoder = Decoder(file)
    assert list(decoder.messages(file.channels[0])) == []
    (sentence,) = decoder.left_out.sentences()
    assert "more than 11." in sentence
    file.close()


@pytest.mark.parametrize(
    ("encoding", "schema", "fits"),
    [
        ("cdr", "ros2msg", True),
        ("cdr", "ros2idl", True),
        ("json", "jsonschema", False),
        ("cdr", "protobuf", False),
        ("ros1", "ros1msg", False),
    ],
)
def test_what_can_be_decoded_is_told_by_its_encoding(
    file: McapFile, encoding: str, schema: str, fits: bool
):
    channel = SimpleNamespace(encoding=encoding, schema_encoding=schema)
    assert Decoder(file).can_decode(channel) is fits  # type: ignore[arg-type]


def test_stamps_are_whole_nanoseconds():
    stamp = header(STAMPS[1], "eye")["stamp"]
    message = SimpleNamespace(header=SimpleNamespace(stamp=SimpleNamespace(**stamp)))
    assert stamp_of(message) == STAMPS[1]
