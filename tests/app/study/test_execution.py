import re
import sys
from pathlib import Path

import pytest

from app.errors import InputError
from app.study.execution import outcomes
from app.study.rows import Row, rows_of
from app.study.work import EvaluationCase, Recorded, Simulated, Work, run_work
from estimator import Parameters
from tests.recordings.room import write_room

ASKS = (EvaluationCase(Parameters()), EvaluationCase(Parameters(method="baseline")))
SIMULATED = Work(Simulated("towards", 0.3, 2), ASKS)


@pytest.fixture(scope="module")
def works(tmp_path_factory: pytest.TempPathFactory) -> list[Work]:
    folder = tmp_path_factory.mktemp("rooms")
    rooms = [write_room(folder / f"room_{seed}.mcap", frames=12, seed=seed) for seed in (1, 2)]
    return [Work(Recorded(room.path), ASKS) for room in rooms]


def rows(works: list[Work], jobs: int, dask: str | None = None) -> list[Row]:
    done = sorted(outcomes(works, jobs, dask), key=lambda outcome: outcome.source.name)
    assert not any(outcome.failure for outcome in done)
    return rows_of(done)


@pytest.fixture(scope="module")
def one_core(works: list[Work]) -> list[Row]:
    found = rows(works, 1)
    assert len(found) == 4
    assert all(row.metrics["points_with_flow"] for row in found)
    return found


def test_two_cores_give_what_one_gives(works: list[Work], one_core: list[Row]):
    assert rows(works, 2) == one_core


def test_a_dask_cluster_gives_what_one_core_gives(
    works: list[Work], one_core: list[Row], scheduler: str
):
    assert rows(works, 1, scheduler) == one_core


def test_a_scheduler_that_is_not_there_is_said(monkeypatch: pytest.MonkeyPatch):
    pytest.importorskip("distributed", reason="distributed is not installed")
    monkeypatch.setattr("app.execution.cluster._PATIENCE", 1)
    with pytest.raises(InputError, match=r"no Dask scheduler at tcp://127\.0\.0\.1:9"):
        list(outcomes([SIMULATED], 1, "tcp://127.0.0.1:9"))


def test_without_distributed_it_is_said_what_to_install(monkeypatch: pytest.MonkeyPatch):
    monkeypatch.setitem(sys.modules, "distributed", None)
    with pytest.raises(InputError, match=r"tofscope\[dask\]"):
        list(outcomes([SIMULATED], 1, "tcp://127.0.0.1:9"))


def test_a_broken_recording_costs_only_itself(tmp_path: Path):
    broken = tmp_path / "broken.mcap"
    broken.write_bytes(b"nonsense")
    works = [Work(Recorded(broken), ASKS), Work(Recorded(tmp_path / "absent.mcap"), ASKS)]
    done = list(outcomes(works, 1))
    assert [bool(outcome.failure) for outcome in done] == [True, True]
    assert "not an MCAP file" in str(done[0].failure)


def test_a_worker_of_another_version_is_refused():
    outcome = run_work(SIMULATED, "another")
    assert "another version" in str(outcome.failure)
    assert not outcome.results


def test_an_unforeseen_error_is_a_failure_of_that_recording(
    works: list[Work], monkeypatch: pytest.MonkeyPatch
):
    def explode(*_: object, **__: object) -> None:
        raise ZeroDivisionError("oh")

    monkeypatch.setattr("app.study.work.evaluate_all", explode)
    (outcome,) = outcomes(works[1:], 1)
    assert outcome.failure == "room_2: ZeroDivisionError: oh"


def test_the_sweep_is_only_for_the_scenario_that_is_swept():
    ten = Parameters(n=10)
    work = Work(Simulated("towards", 0.3, 1), ASKS, sweep=(Parameters(), ten))
    assert work.wanted("sideways") == ASKS
    assert work.wanted("towards") == (*ASKS, EvaluationCase(ten, resting=False))


def test_where_an_alignment_is_wrong_fitness_and_displacement_are_said():
    found = rows([SIMULATED], 1)
    # With the baseline errors are large because what rests is moved, too.
    assert [row.diagnosis is None for row in found] == [False, True]
    why = str(found[0].diagnosis)
    assert re.fullmatch(
        r"In \d of \d pairs with a flow ICP aligns the moving cluster wrongly: fitness "
        r"0\.\d\d to 0\.\d\d, mean displacement (0\.\d\d) to 0\.\d\d m, where it went 0\.16 m\.",
        why,
    )
    assert float(why.partition("displacement ")[2][:4]) > 1.5 * 0.16


def test_where_nothing_got_a_flow_it_is_said_what_became_of_what_moves():
    far = (EvaluationCase(Parameters(n=10), resting=False),)
    (outcome,) = outcomes([Work(Simulated("towards", 0.3, 1), far)], 1)
    (result,) = outcome.results
    assert result.metrics is not None
    assert result.metrics["pairs"] == 5
    assert result.metrics["points_with_flow"] == 0
    assert result.metrics["angle_deg"] is None
    assert "moving points: Unassigned" in str(result.diagnosis)
