import logging
import threading

from app.errors import InputError
from app.session.outbox import Notice
from app.session.tasks import TaskEvent, Tasks, TaskState
from tests.app.waiting import until

TITLE = "Film"


class Bench:
    """Tasks, and all that was told of them."""

    def __init__(self):
        self.events: list[TaskEvent] = []
        self.tasks = Tasks(self.events.append)

    def results(self):
        """Messages of the task, once it has ended."""
        until(lambda: self.events and self.events[-1].text is None)
        messages = [m for event in self.events for m in self.tasks.receive(event)]
        self.events.clear()
        return messages


def test_a_task_runs_beside_the_session_and_hands_out_its_results():
    bench, go_on = Bench(), threading.Event()

    def job(report):
        assert go_on.wait(10)
        return [Notice(TITLE, "It is there.")]

    bench.tasks.start(TITLE, "Begun.", job)
    assert bench.tasks.running(TITLE)
    assert bench.tasks.states == (TaskState(TITLE, "Begun."),)
    go_on.set()
    assert bench.results() == [Notice(TITLE, "It is there.")]
    assert not bench.tasks.running(TITLE)
    assert bench.tasks.states == ()


def test_reports_are_told_now_and_then(monkeypatch):
    monkeypatch.setattr("app.session.tasks._REPORT_INTERVAL", 0.0)
    bench = Bench()

    def job(report):
        for k in range(3):
            report(f"{k} of 3")
        return []

    bench.tasks.start(TITLE, "Begun.", job)
    until(lambda: len(bench.events) == 4)
    assert [event.text for event in bench.events] == ["0 of 3", "1 of 3", "2 of 3", None]
    bench.tasks.receive(bench.events[1])
    assert bench.tasks.states == (TaskState(TITLE, "1 of 3"),)


def test_reports_that_come_too_fast_are_left_out():
    bench = Bench()

    def job(report):
        for k in range(1000):
            report(f"{k} of 1000")
        return []

    bench.tasks.start(TITLE, "Begun.", job)
    assert bench.results() == []


def test_the_end_of_the_client_ends_a_task_at_its_next_report():
    bench, reached, go_on, done = Bench(), threading.Event(), threading.Event(), []

    def job(report):
        reached.set()
        assert go_on.wait(10)
        report("Half.")
        done.append("all of it")
        return [Notice(TITLE, "It is there.")]

    bench.tasks.start(TITLE, "Begun.", job)
    assert reached.wait(10)
    bench.tasks.end()
    go_on.set()
    assert bench.results() == []
    assert done == []


def test_errors_are_said_and_unexpected_ones_are_logged(caplog):
    bench = Bench()

    def wrong(report):
        raise InputError("Nothing is left.")

    def broken(report):
        raise RuntimeError("oh")

    with caplog.at_level(logging.ERROR):
        bench.tasks.start(TITLE, "Begun.", wrong)
        assert bench.results() == [Notice(TITLE, "Nothing is left.", "red", 10.0)]
        assert not caplog.records
        bench.tasks.start(TITLE, "Begun.", broken)
        said = "It could not be made (RuntimeError: oh)."
        assert bench.results() == [Notice(TITLE, said, "red", 10.0)]
    assert "RuntimeError: oh" in caplog.text
    assert "Traceback" in caplog.text
