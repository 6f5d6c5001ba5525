"""Hostile recordings are opened, or refused in a sentence; see docs/limits.md."""

from pathlib import Path

import numpy as np
import pytest

from tests.fuzz.handmade import HANDMADE
from tests.fuzz.mutants import mutant
from tests.fuzz.seeds import seeds
from tests.fuzz.trial import tried

_MUTANTS, _TOGETHER = 210, 21


@pytest.mark.parametrize("name", HANDMADE)
def test_a_handmade_file_is_opened_or_refused_and_told(tmp_path: Path, name: str):
    made = HANDMADE[name]
    outcome = tried(made.write(tmp_path / f"{name}.mcap"))
    assert outcome.faults == ()
    assert made.said in " ".join((outcome.refusal, *outcome.told))


@pytest.mark.parametrize("first", range(0, _MUTANTS, _TOGETHER))
def test_mutants_are_opened_or_refused_in_a_sentence(tmp_path: Path, first: int):
    good = list(seeds().values())
    path = tmp_path / "mutant.mcap"
    for number in range(first, first + _TOGETHER):
        path.write_bytes(mutant(good[number % 3], np.random.default_rng([7, number])))
        assert tried(path).faults == (), f"python -m tests.fuzz --seed 7: number {number}"


@pytest.mark.parametrize("first", range(0, _MUTANTS // 2, _TOGETHER))
def test_so_are_mutants_that_are_read_like_long_recordings(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, first: int
):
    monkeypatch.setattr("recordings.mcap_index.LONG", 1)
    monkeypatch.setattr("recordings.nearby.LONG_TOPIC", 1)
    good = list(seeds().values())
    path = tmp_path / "mutant.mcap"
    for number in range(first, first + _TOGETHER):
        path.write_bytes(mutant(good[number % 3], np.random.default_rng([8, number])))
        assert tried(path).faults == (), f"number {number}"


def test_good_recordings_are_opened_without_a_word(tmp_path: Path):
    for name, content in seeds().items():
        path = tmp_path / f"{name}.mcap"
        path.write_bytes(content)
        outcome = tried(path)
        assert (outcome.refusal, outcome.told, outcome.faults) == ("", (), ()), name
