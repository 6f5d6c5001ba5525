import pytest

from app.study.progress import Progress, duration
from app.study.work import EvaluationCase, Simulated, Source, Work
from estimator import Parameters


def works(*names: str, sweep: int = 0) -> list[Work]:
    values = tuple(Parameters(n=n) for n in range(1, sweep + 1))
    return [Work(_source(name), (EvaluationCase(Parameters()),), values) for name in names]


def _source(name: str) -> Source:
    return Simulated(name, 0.3, 1)


def at(monkeypatch: pytest.MonkeyPatch, *times: float) -> None:
    clock = iter(times)
    monkeypatch.setattr("app.study.progress.monotonic", lambda: next(clock))


def test_what_is_left_is_said_in_a_plain_line_where_there_is_no_terminal(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
):
    at(monkeypatch, 100.0, 110.0, 120.0, 130.0)
    progress = Progress(works("a", "b", "c"), total=5)
    for name in "abc":
        progress.advance(_source(name))
    progress.close()
    # Those from before took no time: 10 s each for the two that are left.
    assert capsys.readouterr().out.splitlines() == [
        "3/5  a_0.3_1  2 left, about 20 s",
        "4/5  b_0.3_1  1 left, about 10 s",
        "5/5  c_0.3_1  all finished",
    ]
    assert progress.finished == 5


def test_what_is_under_way_on_other_cores_counts_as_begun(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
):
    # Each takes 40 s of one core: two by two they are finished after 80 s.
    at(monkeypatch, 0.0, 40.0, 40.0, 80.0, 80.0)
    progress = Progress(works("a", "b", "c", "d"), total=4, at_once=2)
    for name in "badc":
        progress.advance(_source(name))
    assert [line.partition("left, ")[2] for line in capsys.readouterr().out.splitlines()] == [
        "about 40 s",  # one is as good as finished, two are left for two cores
        "about 40 s",
        "about 0 s",
        "",
    ]


def test_a_recording_with_a_sweep_takes_longer_than_one_without(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
):
    at(monkeypatch, 0.0, 120.0)
    # 10 estimates and the simulation, and then 1 estimate and the simulation.
    progress = Progress([*works("towards", sweep=10), *works("sideways", sweep=10)], total=2)
    progress.advance(_source("towards"))
    assert "1 left, about 30 s" in capsys.readouterr().out


def test_on_a_terminal_one_line_is_written_over_and_never_wraps(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
):
    monkeypatch.setattr("sys.stdout.isatty", lambda: True)
    monkeypatch.setenv("COLUMNS", "30")
    progress = Progress(works("a" * 50, "b"), total=2)
    progress.advance(_source("a" * 50))
    progress.close()
    shown = capsys.readouterr().out
    assert "\n" not in shown
    lines = [line.removeprefix("\x1b[K") for line in shown.split("\r")]
    assert max(map(len, lines)) == 29
    assert lines[-1] == ""


@pytest.mark.parametrize(("seconds", "said"), [(4.6, "5 s"), (99, "99 s"), (125, "2 min 05 s")])
def test_durations_are_said_as_people_say_them(seconds: float, said: str):
    assert duration(seconds) == said
