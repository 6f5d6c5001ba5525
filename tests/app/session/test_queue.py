import threading
import time
from dataclasses import dataclass

import pytest

from app.panels.compare import SwitchSide
from app.panels.playback_commands import JumpToMotion, ToggleLoop
from app.panels.view import CameraMoved
from app.session.commands import (
    ChangeParameters,
    Move,
    ResetParameters,
    TogglePlay,
    seek,
    step,
)
from app.session.queue import CommandQueue


def test_the_latest_command_of_a_kind_wins():
    queue = CommandQueue()
    for frame in range(200):
        queue.post(seek(frame))
    assert queue.take() == [seek(199)]
    assert queue.take(timeout=0) == []


def test_commands_of_different_kinds_keep_their_order():
    commands = [
        ChangeParameters({"delta": 0.5}, {}),
        SwitchSide(),  # to the other parameters, which the next change is meant for
        ChangeParameters({"delta": 0.1}, {}),
        ResetParameters(frozenset(["gamma", "delta"])),
        ChangeParameters({"delta": 0.2}, {}),
        ResetParameters(frozenset(["gamma"])),
    ]
    queue = CommandQueue()
    for command in commands:
        queue.post(command)
    assert queue.take() == commands


def test_relative_commands_add_up():
    queue = CommandQueue()
    for _ in range(3):
        queue.post(step(-1))
    for _ in range(3):
        queue.post(TogglePlay())
    assert queue.take() == [step(-3), TogglePlay(3)]


def test_what_comes_from_the_background_is_merged_and_keeps_nothing_apart():
    queue = CommandQueue()
    for frame in range(100):
        queue.post(seek(frame))
        queue.post(CameraMoved())
    assert queue.take() == [seek(99), CameraMoved()]


def test_jumps_and_switches_count_as_often_as_they_are_asked_for():
    queue = CommandQueue()
    for command in (JumpToMotion((1,)), JumpToMotion((1,)), ToggleLoop(), ToggleLoop()):
        queue.post(command)
    assert queue.take() == [JumpToMotion((1, 1)), ToggleLoop(2)]


@pytest.mark.parametrize(
    ("commands", "frame"),
    [
        ((step(1), seek(0), step(1)), 1),
        ((seek(5), step(1), seek(3)), 3),
        ((step(2), step(-1)), 11),
        ((seek(10**9), step(-1)), 38),
        ((seek(-7), step(2)), 2),
    ],
)
def test_steps_and_frames_that_are_named_keep_their_order(commands, frame):
    class Workbench:
        frame = 10

        def seek(self, frame):
            self.frame = min(max(frame, 0), 39)

    queue, workbench = CommandQueue(), Workbench()
    for command in commands:
        queue.post(command)
    taken = queue.take()
    assert taken is not None
    assert [type(command) for command in taken] == [Move]
    taken[0].apply(workbench)  # pyright: ignore[reportArgumentType]
    assert workbench.frame == frame


def test_changes_of_different_parameters_are_all_kept():
    queue = CommandQueue()
    queue.post(ChangeParameters({"delta": 0.1, "n": 3}, {}))
    queue.post(ChangeParameters({"delta": 0.2}, {}))
    assert queue.take() == [ChangeParameters({"delta": 0.2, "n": 3}, {})]


def test_a_post_wakes_who_waits():
    queue = CommandQueue()
    threading.Timer(0.05, lambda: queue.post(seek(1))).start()
    start = time.monotonic()
    assert queue.take(timeout=10) == [seek(1)]
    assert time.monotonic() - start < 5


def test_closing_ends_every_wait():
    queue = CommandQueue()
    queue.post(seek(1))
    threading.Timer(0.05, queue.close).start()
    queue.take()
    assert queue.take() is None
    assert queue.take() is None


def test_nothing_is_lost_between_threads():
    queue = CommandQueue()
    steps, taken = 2000, []

    def post():
        for _ in range(steps):
            queue.post(step(1))

    threads = [threading.Thread(target=post) for _ in range(4)]
    for thread in threads:
        thread.start()
    while any(thread.is_alive() for thread in threads):
        taken += queue.take(timeout=0.01) or []
    taken += queue.take(timeout=0) or []
    assert sum(command.steps for command in taken) == 4 * steps


def test_any_class_that_can_be_merged_and_applied_is_a_command():
    @dataclass
    class Longest:
        text: str

        def merged_with(self, earlier):
            return max(self, earlier, key=lambda command: len(command.text))

        def apply(self, workbench):
            raise NotImplementedError

    queue = CommandQueue()
    for text in ("a", "abc", "ab"):
        queue.post(Longest(text))
    assert queue.take() == [Longest("abc")]
