from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from recordings.decoding import Decoder
from recordings.layouts import Samples, all_samples
from recordings.mcap_file import McapFile
from recordings.message_kinds import JOINTS, POSE, TRANSFORMS, TWIST, Kind
from tests.recordings.foreign import ForeignFile, at, joint_state, pose, transforms, twist

NAMES = st.text("abc/é", max_size=5)
NUMBERS = st.floats(-1e6, 1e6)
STAMPS = st.integers(0, 2**31 * 10**9 - 1)
KINDS = {
    "/tf": TRANSFORMS,
    "/joint_states": JOINTS,
    "/target/velocity": TWIST,
    "/target/pose": POSE,
}
QUICK = settings(
    max_examples=30, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture]
)


def one_by_one(decoder: Decoder, file: McapFile, topic: str, kind: Kind) -> Iterator[tuple]:
    channel = next(c for c in file.channels if c.topic == topic)
    for message in decoder.messages(channel):
        yield from kind.fields(message)


def copied(file: McapFile, decoder: Decoder, topic: str) -> tuple[list, Samples]:
    channel, names = next(c for c in file.channels if c.topic == topic), []

    def number(name: object) -> int:
        if name not in names:
            names.append(name)
        return names.index(name)

    return names, all_samples(decoder, channel, KINDS[topic], number)


@QUICK
@given(st.data(), st.lists(st.lists(st.tuples(NAMES, NAMES), max_size=3), min_size=1, max_size=3))
def test_numbers_are_those_of_each_message_decoded(tmp_path: Path, data: st.DataObject, trees):
    foreign = ForeignFile()
    for n in range(12):
        stamp, tree = data.draw(STAMPS), data.draw(st.sampled_from(trees))
        x, y = data.draw(NUMBERS), data.draw(NUMBERS)
        moved = [(parent, child, at(x, y, float(n), 0.1 * n)) for parent, child in tree]
        foreign.add("/tf", "tf2_msgs/msg/TFMessage", transforms(stamp, moved), n)
        joints = {child: x + n for _, child in tree}
        foreign.add("/joint_states", "sensor_msgs/msg/JointState", joint_state(stamp, joints), n)
        speed = np.array([x, y, n])
        velocity = twist(stamp, data.draw(NAMES), speed)
        foreign.add("/target/velocity", "geometry_msgs/msg/TwistStamped", velocity, n)
        posed = pose(stamp, "base", at(x, y))
        foreign.add("/target/pose", "geometry_msgs/msg/PoseStamped", posed, n)
    file = McapFile(foreign.write(tmp_path / "any.mcap"))
    decoder = Decoder(file)
    for topic, kind in KINDS.items():
        expected = list(one_by_one(decoder, file, topic, kind))
        names, found = copied(file, decoder, topic)
        assert [names[n] for n in found.of.tolist()] == [name for name, _, _ in expected]
        assert found.stamps.tolist() == [stamp for _, stamp, _ in expected]
        assert found.values.tolist() == [list(values) for _, _, values in expected]
        assert names == list(dict.fromkeys(name for name, _, _ in expected))
    file.close()


def test_few_messages_of_one_layout_are_decoded(tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
    foreign = ForeignFile()
    for n in range(50):
        tf = transforms(n, [("base", "arm", at(x=float(n))), ("arm", "hand", at(turn=0.01 * n))])
        foreign.add("/tf", "tf2_msgs/msg/TFMessage", tf, n)
    file = McapFile(foreign.write(tmp_path / "tf.mcap"))
    decoder = Decoder(file)
    decoded: list[int] = []
    decode = decoder.decode

    def noted(channel: object, index: int) -> object:
        decoded.append(index)
        return decode(channel, index)  # type: ignore[arg-type]

    monkeypatch.setattr(decoder, "decode", noted)
    _, found = copied(file, decoder, "/tf")
    assert decoded == [0]
    assert found.values[found.of == 0, 0].tolist() == list(range(50))
    file.close()


def test_a_message_that_does_not_fit_is_left_out_and_noted(tmp_path: Path):
    foreign = ForeignFile()
    for n in range(3):
        foreign.add("/target/pose", "geometry_msgs/msg/PoseStamped", pose(n, "base", at(x=n)), n)
    path = foreign.write(tmp_path / "pose.mcap")
    file = McapFile(path)
    decoder = Decoder(file)
    whole = file.message

    def cut(channel: object, index: int) -> bytes:
        data = whole(channel, index)  # type: ignore[arg-type]
        return data[:-20] if index == 1 else data

    file.message = cut  # type: ignore[method-assign]
    _, found = copied(file, decoder, "/target/pose")
    assert found.values[:, 0].tolist() == [0.0, 2.0]
    assert len(decoder.left_out.sentences()) == 1
    file.close()
