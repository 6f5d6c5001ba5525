from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest

from recordings import Provenance, RecordingError
from recordings.provenance import PROVENANCE_RECORD, provenance_of, provenance_record

OLD = Provenance(
    simulated=True,
    scenario="towards",
    speed=0.15,
    trial=2,
    seed=7,
    noise="none",
    command="tofscope simulate towards",
)


def file(record: dict[str, str] | None) -> Any:
    metadata = {} if record is None else {PROVENANCE_RECORD: record}
    return SimpleNamespace(path=Path("x.mcap"), metadata=metadata.get)


@pytest.mark.parametrize(
    "provenance",
    [OLD, replace(OLD, rig="two eyes"), replace(OLD, imperfections=("bias", "ramps"), rig="a b")],
)
def test_a_record_says_where_a_recording_comes_from(provenance: Provenance):
    assert provenance_of(file(provenance_record(provenance))) == provenance


def test_an_older_record_says_no_rig_and_stays_as_it_was():
    record = provenance_record(OLD)
    assert set(record) == {"simulated", "scenario", "speed", "trial", "seed", "noise", "command"}
    assert provenance_of(file(record)) == OLD
    assert OLD.rig == ""


def test_other_files_come_from_nowhere():
    assert provenance_of(file(None)) is None


def test_a_record_that_is_not_ours_is_refused():
    with pytest.raises(RecordingError, match=r"'tofscope' must hold .*, command; wrong"):
        provenance_of(file(provenance_record(OLD) | {"trial": "first"}))
