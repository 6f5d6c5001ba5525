import gc
import threading
import time
import weakref

import app.server.memory_release
from app.server.memory_release import MemoryRelease, release


class Loop:
    """Something that only the garbage collector frees."""

    def __init__(self):
        self.me = self


def test_what_only_the_collector_frees_is_freed():
    gc.disable()
    try:
        left = weakref.ref(Loop())
        assert left() is not None
        release()
        assert left() is None
    finally:
        gc.enable()


def test_many_who_leave_together_cost_once(monkeypatch):
    calls, done = [], threading.Event()
    monkeypatch.setattr(app.server.memory_release, "_QUIET", 0.1)
    monkeypatch.setattr(app.server.memory_release, "release", lambda: (calls.append(1), done.set()))
    memory = MemoryRelease()
    for _ in range(20):
        memory.soon()
    assert done.wait(5)
    time.sleep(0.3)
    assert len(calls) == 1


def test_nothing_is_left_to_do_after_closing(monkeypatch):
    calls = []
    monkeypatch.setattr(app.server.memory_release, "_QUIET", 0.1)
    monkeypatch.setattr(app.server.memory_release, "release", lambda: calls.append(1))
    memory = MemoryRelease()
    memory.soon()
    memory.close()
    time.sleep(0.3)
    assert calls == []
