import gc
import subprocess
import sys
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


def test_threads_share_two_heaps():
    fill = "[threading.Thread(target=lambda: kept.append([bytearray(600) for _ in range(50)]))"
    script = f"""
import threading, time
from pathlib import Path
from app.server.memory_release import keep_together
keep_together()
kept = []
threads = {fill} for _ in range(8)]
for thread in threads: thread.start()
for thread in threads: thread.join()
import ctypes
ctypes.CDLL(None).malloc_info(0, ctypes.c_void_p.in_dll(ctypes.CDLL(None), "stdout"))
ctypes.CDLL(None).fflush(None)
"""
    told = subprocess.run(
        [sys.executable, "-c", script], check=True, capture_output=True, text=True
    )
    assert 1 <= told.stdout.count("<heap nr=") <= 2, told.stderr
