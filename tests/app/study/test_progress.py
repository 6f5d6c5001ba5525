import pytest

from app.study.progress import Progress, duration


def test_what_is_left_is_said_in_a_plain_line_where_there_is_no_terminal(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
):
    clock = iter([100.0, 110.0, 120.0])
    monkeypatch.setattr("app.study.progress.monotonic", lambda: next(clock))
    progress = Progress(total=5, finished=2)
    progress.advance("a")
    progress.advance("b")
    progress.advance("c")
    progress.close()
    # Those from before took no time: 10 s each for the two that are left.
    assert capsys.readouterr().out.splitlines() == [
        "3/5  a  2 left, about 20 s",
        "4/5  b  1 left, about 10 s",
        "5/5  c  all finished",
    ]
    assert progress.finished == 5


def test_on_a_terminal_one_line_is_written_over_and_never_wraps(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
):
    monkeypatch.setattr("sys.stdout.isatty", lambda: True)
    monkeypatch.setenv("COLUMNS", "30")
    progress = Progress(total=2, finished=0)
    progress.advance("a" * 50)
    progress.close()
    shown = capsys.readouterr().out
    assert "\n" not in shown
    lines = [line.removeprefix("\x1b[K") for line in shown.split("\r")]
    assert max(map(len, lines)) == 29
    assert lines[-1] == ""


@pytest.mark.parametrize(("seconds", "said"), [(4.6, "5 s"), (99, "99 s"), (125, "2 min 05 s")])
def test_durations_are_said_as_people_say_them(seconds: float, said: str):
    assert duration(seconds) == said
