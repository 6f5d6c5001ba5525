import pytest

from app.study.progress import Progress, duration
from app.study.work import EvaluationCase, Simulated, Source, Work
from estimator import Parameters
from tests.app.terminal.screen import Screen


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


def test_on_a_terminal_a_bar_is_written_over(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
):
    monkeypatch.setattr("sys.stdout.isatty", lambda: True)
    monkeypatch.setenv("TERM", "xterm-256color")
    monkeypatch.setenv("COLUMNS", "60")
    at(monkeypatch, 100.0, 110.0, 120.0)
    progress = Progress(works("a" * 50, "b"), total=3)
    written = capsys.readouterr().out
    assert Screen(written, 60).lines[0].startswith("1/3 ")
    assert Screen(written, 60).lines[0].endswith(" 2 left")
    progress.advance(_source("a" * 50))
    written += capsys.readouterr().out
    (line,) = Screen(written, 60).lines
    assert line.startswith("2/3 ")
    assert line.endswith(" 1 left, about 10 s")
    assert "aaaa…" in line
    progress.close()
    progress.close()
    written += capsys.readouterr().out
    assert Screen(written, 60).lines == []


def test_names_do_a_terminal_no_harm(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
):
    at(monkeypatch, 0.0, 1.0)
    progress = Progress(works("\x1b[2J"), total=1)
    progress.advance(_source("\x1b[2J"))
    assert capsys.readouterr().out == "1/1  \\x1b[2J_0.3_1  all finished\n"


@pytest.mark.parametrize(("seconds", "said"), [(4.6, "5 s"), (99, "99 s"), (125, "2 min 05 s")])
def test_durations_are_said_as_people_say_them(seconds: float, said: str):
    assert duration(seconds) == said
