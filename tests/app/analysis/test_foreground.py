import threading
import time

import pytest

from app.analysis.foreground import Foreground


def waits(foreground: Foreground, seconds: float) -> float:
    begin = time.monotonic()
    foreground.wait_until_quiet(seconds)
    return time.monotonic() - begin


def test_without_foreground_work_there_is_no_wait():
    assert waits(Foreground(), 5.0) < 1.0


def test_it_waits_for_the_time_of_quiet_after_the_work():
    foreground = Foreground()
    with foreground:
        pass
    assert waits(foreground, 0.2) > 0.15


def test_it_waits_for_work_that_is_under_way():
    foreground, ended = Foreground(), threading.Event()

    def work():
        with foreground:
            started.set()
            time.sleep(0.2)
            ended.set()

    started = threading.Event()
    threading.Thread(target=work).start()
    started.wait()
    foreground.wait_until_quiet(0.0)
    assert ended.is_set()


def test_work_that_fails_has_ended():
    foreground = Foreground()
    with pytest.raises(ValueError, match="broken"), foreground:
        raise ValueError("broken")
    foreground.wait_until_quiet(0.0)


def test_it_waits_no_longer_than_it_is_told_also_where_it_is_never_quiet():
    foreground, begun, ended = Foreground(), threading.Event(), threading.Event()

    def play():
        while not ended.wait(0.02):
            with foreground:
                begun.set()
                time.sleep(0.02)

    thread = threading.Thread(target=play, daemon=True)
    thread.start()
    assert begun.wait(10)
    begin = time.monotonic()
    foreground.wait_until_quiet(0.6, at_most=0.3)
    assert 0.25 < time.monotonic() - begin < 3.0
    ended.set()
    thread.join()
    with foreground:
        foreground.wait_until_quiet(0.6, at_most=0.1)
