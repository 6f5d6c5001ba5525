import threading
from dataclasses import dataclass, field

from app.analysis.turns import Turns
from tests.app.waiting import until


@dataclass
class Asked:
    steps: int
    done: list[int] = field(default_factory=list)
    wanted: bool = True


def test_requests_are_worked_on_in_turn_until_they_are_finished():
    order, go_on = [], threading.Event()

    def step(asked, among):
        assert go_on.wait(10)
        order.append((asked.steps, among))
        asked.done.append(among)
        return len(asked.done) == asked.steps

    turns: Turns[Asked] = Turns("turns", step, lambda _: "", daemon=True)
    two, three = Asked(2), Asked(3)
    turns.add("two", two)
    turns.add("three", three)
    go_on.set()
    until(lambda: turns.idle)
    assert (len(two.done), len(three.done)) == (2, 3)
    assert order[-1][0] == 3


def test_a_request_takes_the_place_of_its_owners_earlier_one():
    turns: Turns[Asked] = Turns("turns", lambda *_: False, lambda _: "", daemon=True)
    first, second = Asked(1), Asked(1)
    turns.add("me", first)
    turns.add("me", second)
    assert (first.wanted, second.wanted) == (False, True)
    turns.cancel("me")
    assert not second.wanted
    until(lambda: turns.idle)


def test_an_error_is_logged_unless_the_request_was_withdrawn(caplog):
    def step(asked, _):
        asked.wanted = asked.steps == 1
        raise ValueError("broken")

    turns: Turns[Asked] = Turns("turns", step, lambda asked: f"{asked.steps} failed", daemon=True)
    turns.add("kept", Asked(1))
    turns.add("withdrawn", Asked(2))
    until(lambda: turns.idle)
    assert "1 failed" in caplog.text
    assert "2 failed" not in caplog.text
