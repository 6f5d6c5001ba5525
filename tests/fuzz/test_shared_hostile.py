"""Hostile recordings that are no part of this repository."""

from pathlib import Path

import pytest

from tests.fuzz.trial import tried


def test_shared_hostile_files_are_opened_or_refused(shared_data: Path):
    paths = sorted((shared_data / "hostile").glob("*.mcap"))
    if not paths:
        pytest.skip("there is no folder of hostile recordings")
    assert {path.name: tried(path).faults for path in paths} == {path.name: () for path in paths}
