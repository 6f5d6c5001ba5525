import threading
import time
from dataclasses import dataclass

import pytest

from app.session.commands import ChangeParameters, Move, TogglePlay, seek, step
from app.session.queue import Mailbox


def test_the_latest_wish_of_a_kind_wins():
    mailbox = Mailbox()
    for frame in range(200):
        mailbox.post(seek(frame))
    assert mailbox.take() == [seek(199)]
    assert mailbox.take(timeout=0) == []


def test_kinds_do_not_push_each_other_out_and_come_in_the_order_of_their_last_post():
    mailbox = Mailbox()
    mailbox.post(seek(1))
    mailbox.post(TogglePlay())
    mailbox.post(seek(2))
    assert mailbox.take() == [TogglePlay(), seek(2)]


def test_relative_wishes_add_up():
    mailbox = Mailbox()
    for _ in range(3):
        mailbox.post(step(-1))
        mailbox.post(TogglePlay())
    assert mailbox.take() == [step(-3), TogglePlay(3)]


@pytest.mark.parametrize(
    ("wishes", "frame"),
    [
        ((step(1), seek(0), step(1)), 1),
        ((seek(5), step(1), seek(3)), 3),
        ((step(2), step(-1)), 11),
        ((seek(10**9), step(-1)), 38),
        ((seek(-7), step(2)), 2),
    ],
)
def test_steps_and_frames_that_are_named_keep_their_order(wishes, frame):
    class Workbench:
        frame = 10

        def seek(self, frame):
            self.frame = min(max(frame, 0), 39)

    mailbox, workbench = Mailbox(), Workbench()
    for wish in wishes:
        mailbox.post(wish)
    taken = mailbox.take()
    assert taken is not None
    assert [type(wish) for wish in taken] == [Move]
    taken[0].fulfil(workbench)  # pyright: ignore[reportArgumentType]
    assert workbench.frame == frame


def test_changes_of_different_parameters_are_all_kept():
    mailbox = Mailbox()
    mailbox.post(ChangeParameters({"delta": 0.1, "n": 3}))
    mailbox.post(ChangeParameters({"delta": 0.2}))
    assert mailbox.take() == [ChangeParameters({"delta": 0.2, "n": 3})]


def test_a_post_wakes_who_waits():
    mailbox = Mailbox()
    threading.Timer(0.05, lambda: mailbox.post(seek(1))).start()
    start = time.monotonic()
    assert mailbox.take(timeout=10) == [seek(1)]
    assert time.monotonic() - start < 5


def test_closing_ends_every_wait():
    mailbox = Mailbox()
    mailbox.post(seek(1))
    threading.Timer(0.05, mailbox.close).start()
    mailbox.take()
    assert mailbox.take() is None
    assert mailbox.take() is None


def test_nothing_is_lost_between_threads():
    mailbox = Mailbox()
    steps, taken = 2000, []

    def post():
        for _ in range(steps):
            mailbox.post(step(1))

    threads = [threading.Thread(target=post) for _ in range(4)]
    for thread in threads:
        thread.start()
    while any(thread.is_alive() for thread in threads):
        taken += mailbox.take(timeout=0.01) or []
    taken += mailbox.take(timeout=0) or []
    assert sum(wish.steps for wish in taken) == 4 * steps


def test_any_class_with_after_is_a_wish():
    @dataclass
    class Longest:
        text: str

        def after(self, earlier):
            return max(self, earlier, key=lambda wish: len(wish.text))

        def fulfil(self, workbench):
            raise NotImplementedError

    mailbox = Mailbox()
    for text in ("a", "abc", "ab"):
        mailbox.post(Longest(text))
    assert mailbox.take() == [Longest("abc")]
