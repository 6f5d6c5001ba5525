from types import SimpleNamespace
from typing import Any

import pytest

from recordings.rig_record import RIG_ATTACHMENT, depth_topic, packed, rig_of, topic_part
from robot_assets import load_rig, rig_text


def file(content: bytes | None) -> Any:
    return SimpleNamespace(attachment={}.get if content is None else {RIG_ATTACHMENT: content}.get)


def test_a_rig_comes_back_from_its_attachment():
    rig, warnings = rig_of(file(packed(load_rig())))
    assert rig is not None
    assert rig_text(rig) == rig_text(load_rig())
    assert warnings == []


def test_files_without_it_have_none():
    assert rig_of(file(None)) == (None, [])


@pytest.mark.parametrize(
    ("content", "said"),
    [
        (b"\xff", "rig.toml in the file is not a text file, so it cannot be a rig file."),
        (b"name = 7", "rig.toml in the file: name must be a text, got 7; "),
        (b"#" * 1_000_001, "The file's own rig has 1000001 bytes, too many"),
    ],
)
def test_one_that_cannot_be_used_is_said(content: bytes, said: str):
    rig, warnings = rig_of(file(content))
    assert rig is None
    assert len(warnings) == 1
    assert warnings[0].startswith(said)
    assert warnings[0].lower().endswith("it is not used.")


def test_a_sensors_name_stands_in_its_topic():
    assert depth_topic(topic_part("/left arm/3")) == "/tof/left_arm/3/image"
