import hashlib
from dataclasses import replace
from pathlib import Path

import pytest

from app.errors import InputError
from app.study.store import Store
from app.study.work import EvaluationCase, Outcome, Recorded, Result, Simulated, Work
from estimator import Parameters

SOURCE = Simulated("towards", 0.3, 1)
EIGHT, TEN = Parameters(), Parameters(n=10)


def finished(
    source: Simulated | Recorded, *cases: EvaluationCase, scenario: str = "towards"
) -> Outcome:
    results = tuple(
        Result(case, {"pairs": 7, "angle_deg": 0.1 + 0.2}, 1.5, "why") for case in cases
    )
    return Outcome(source, scenario, 0.3, 1, "paper", 37, 2.0, results, ("a warning",))


def test_what_is_kept_comes_back_as_it_was(tmp_path: Path):
    outcome = finished(SOURCE, EvaluationCase(EIGHT), EvaluationCase(TEN, resting=False))
    work = Work(SOURCE, (EvaluationCase(EIGHT),), sweep=(EIGHT, TEN))
    Store(tmp_path, "ours").keep(outcome)
    store = Store(tmp_path, "ours")
    assert store.finished(work) == outcome
    assert store.missing(work) is None


def test_only_what_is_new_is_left_to_do(tmp_path: Path):
    store = Store(tmp_path, "ours")
    store.keep(finished(SOURCE, EvaluationCase(EIGHT)))
    more = Work(SOURCE, (EvaluationCase(EIGHT), EvaluationCase(replace(EIGHT, method="baseline"))))
    left = store.missing(more)
    assert left is not None
    assert [case.parameters.method for case in left.cases] == ["baseline"]
    store.keep(finished(SOURCE, *left.cases))
    assert store.missing(more) is None
    # A sweep's estimate has no false flow, and is none for a table.
    store.keep(finished(SOURCE, EvaluationCase(TEN, resting=False)))
    assert store.missing(Work(SOURCE, (EvaluationCase(TEN),))) is not None


@pytest.mark.parametrize(
    "other",
    [
        replace(SOURCE, scenario="sideways"),
        replace(SOURCE, speed=0.2),
        replace(SOURCE, trial=2),
        replace(SOURCE, seed=1),
        replace(SOURCE, noise="none"),
        replace(SOURCE, imperfections=("bias",)),
    ],
)
def test_results_of_one_recording_are_not_those_of_another(tmp_path: Path, other: Simulated):
    store = Store(tmp_path, "ours")
    store.keep(finished(SOURCE, EvaluationCase(EIGHT)))
    assert store.finished(Work(other, (EvaluationCase(EIGHT),))) is None


def test_another_version_computes_again(tmp_path: Path):
    Store(tmp_path, "ours").keep(finished(SOURCE, EvaluationCase(EIGHT)))
    assert Store(tmp_path, "newer").finished(Work(SOURCE, (EvaluationCase(EIGHT),))) is None


def test_a_file_is_known_by_its_content_and_by_how_it_is_opened(tmp_path: Path):
    file, rig = tmp_path / "a.mcap", tmp_path / "rig.toml"
    file.write_bytes(b"one")
    rig.write_bytes(b"one")
    source = Recorded(file, rig=rig)
    store = Store(tmp_path / "results", "ours")
    store.keep(finished(source, EvaluationCase(EIGHT)))
    assert store.finished(Work(source, (EvaluationCase(EIGHT),)))
    assert not store.finished(Work(replace(source, truth_frame="panel"), (EvaluationCase(EIGHT),)))
    rig.write_bytes(b"other")
    assert not store.finished(Work(source, (EvaluationCase(EIGHT),)))
    rig.write_bytes(b"one")
    assert store.finished(Work(source, (EvaluationCase(EIGHT),)))
    file.write_bytes(b"other")
    assert not store.finished(Work(source, (EvaluationCase(EIGHT),)))


def test_a_recording_is_read_once_and_has_no_name_in_what_decides_its_results(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
):
    read: list[object] = []

    def digest(file, kind):
        read.append(file.name)
        return hashlib.new(kind, file.read())

    monkeypatch.setattr("hashlib.file_digest", digest)
    (tmp_path / "a.mcap").write_bytes(b"one")
    (tmp_path / "b.mcap").write_bytes(b"one")
    a, b = Recorded(tmp_path / "a.mcap"), Recorded(tmp_path / "b.mcap")
    store = Store(tmp_path / "results", "ours")
    store.keep(finished(a, EvaluationCase(EIGHT)))
    assert store.missing(Work(a, (EvaluationCase(EIGHT),))) is None
    assert store.finished(Work(a, (EvaluationCase(EIGHT),)))
    assert len(read) == 1
    assert store.digest(a) == store.digest(b)


@pytest.mark.parametrize("letter", ["a", "é", "\udcff"])
def test_a_long_name_is_kept_like_any_other(tmp_path: Path, letter: str):
    source = Recorded(tmp_path / f"{letter * 110}.mcap")
    work = Work(source, (EvaluationCase(EIGHT),))
    Store(tmp_path / "results", "ours").keep(finished(source, EvaluationCase(EIGHT)))
    assert Store(tmp_path / "results", "ours").missing(work) is None


def test_what_cannot_be_written_is_said_and_known_all_the_same(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
):
    def full(*_: object) -> None:
        raise OSError(28, "No space left on device")

    store = Store(tmp_path, "ours")
    monkeypatch.setattr("os.replace", full)
    with pytest.raises(InputError, match="cannot be written: No space left on device"):
        store.keep(finished(SOURCE, EvaluationCase(EIGHT)))
    assert list(tmp_path.iterdir()) == []
    assert store.finished(Work(SOURCE, (EvaluationCase(EIGHT),))) == finished(
        SOURCE, EvaluationCase(EIGHT)
    )


def test_half_a_file_is_computed_again_and_a_failure_is_not_kept(tmp_path: Path):
    store = Store(tmp_path, "ours")
    work = Work(SOURCE, (EvaluationCase(EIGHT),))
    store.keep(Outcome(SOURCE, failure="It broke."))
    assert store.missing(work) == work
    store.keep(finished(SOURCE, EvaluationCase(EIGHT)))
    (path,) = tmp_path.glob("*.json")
    path.write_text(path.read_text()[:100])
    assert store.missing(work) == work


@pytest.mark.parametrize(
    "content",
    [100_000 * "[", 100_000 * '{"a":', "[]", '{"results": NaN}', 5000 * "1"],
    ids=["lists", "tables", "a list", "nan", "digits"],
)
def test_nonsense_in_a_file_is_computed_again(tmp_path: Path, content: str):
    work = Work(SOURCE, (EvaluationCase(EIGHT),))
    store = Store(tmp_path, "ours")
    store.keep(finished(SOURCE, *work.cases))
    assert store.missing(work) is None
    next(tmp_path.glob("*.json")).write_text(content)
    assert store.missing(work) == work


def test_a_folder_that_cannot_be_made_is_said(tmp_path: Path):
    (tmp_path / "file").write_text("")
    with pytest.raises(InputError, match="cannot be made"):
        Store(tmp_path / "file" / "results", "ours")
