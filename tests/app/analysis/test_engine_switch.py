"""Which engine estimates while the compiled one is being made, and what people are told of it."""

import subprocess
import threading
from collections.abc import Iterator

import pytest

from app.analysis.engine_switch import COMPILED_NOW, COMPILING, EngineSwitch
from estimator import current_engine
from estimator.engine import compiled, readiness
from estimator.engines import COMPILED, REFERENCE, use_engine
from tests.app.waiting import until


@pytest.fixture(autouse=True)
def _before() -> Iterator[None]:
    before = current_engine()
    yield
    use_engine(before)


class FakeProcess:
    """A process that compiles until it is let go or ended."""

    def __init__(self) -> None:
        self.terminated = False
        self.done = threading.Event()

    def wait(self) -> int:
        assert self.done.wait(10.0)
        return -15 if self.terminated else 0

    def terminate(self) -> None:
        self.terminated = True
        self.done.set()


class Readiness:
    """Fake compiled code: `there` before or not, and how often it was loaded."""

    def __init__(self, monkeypatch: pytest.MonkeyPatch, folder: object) -> None:
        self.there, self.loaded = False, 0
        self.started: list[list[str]] = []
        self.process = FakeProcess()
        monkeypatch.setattr(readiness, "is_compiled", lambda: self.there)
        monkeypatch.setattr(readiness, "compile_all", self.load)
        monkeypatch.setattr(compiled, "cache_folder", lambda: folder)
        monkeypatch.setattr(subprocess, "Popen", self.start)

    def load(self) -> None:
        self.loaded += 1

    def start(self, command: list[str], *, start_new_session: bool) -> FakeProcess:
        assert start_new_session  # or Ctrl-C would reach it, too
        self.started.append(command)
        return self.process


@pytest.fixture
def fake(monkeypatch, tmp_path) -> Readiness:
    return Readiness(monkeypatch, tmp_path)


def told(switch: EngineSwitch) -> list[tuple[str, str]]:
    """What people are told, and the engine's name at that moment."""
    heard: list[tuple[str, str]] = []
    switch.subscribe(lambda said: heard.append((said, current_engine().name)))
    return heard


def test_compiled_before_it_is_loaded_without_a_word(fake):
    fake.there = True
    switch = EngineSwitch()
    heard = told(switch)
    switch.begin(COMPILED)
    until(lambda: heard)
    assert heard == [("", "compiled")]
    assert current_engine() is COMPILED
    assert (fake.started, fake.loaded) == ([], 1)
    assert switch.compiling is False


def test_not_compiled_the_reference_estimates_meanwhile(fake):
    switch = EngineSwitch()
    heard = told(switch)
    switch.begin(COMPILED)
    until(lambda: fake.started)
    assert heard == [(COMPILING, "reference")]
    assert switch.compiling
    assert current_engine() is REFERENCE
    fake.process.done.set()
    until(lambda: not switch.compiling)
    assert heard == [(COMPILING, "reference"), (COMPILED_NOW, "compiled")]
    assert fake.loaded == 1
    assert fake.started[0][1:] == ["-m", "estimator.engine.readiness"]


def test_without_a_folder_to_keep_it_in_this_process_compiles(fake, monkeypatch):
    monkeypatch.setattr(compiled, "cache_folder", lambda: None)
    switch = EngineSwitch()
    heard = told(switch)
    switch.begin(COMPILED)
    until(lambda: len(heard) == 2)
    assert heard == [(COMPILING, "reference"), (COMPILED_NOW, "compiled")]
    assert (fake.started, fake.loaded) == ([], 1)


def test_the_reference_is_used_at_once(fake):
    use_engine(COMPILED)
    switch = EngineSwitch()
    heard = told(switch)
    switch.begin(REFERENCE)
    assert current_engine() is REFERENCE
    assert (heard, fake.started, fake.loaded) == ([], [], 0)


def test_closing_ends_a_compilation(fake):
    switch = EngineSwitch()
    told(switch)
    switch.begin(COMPILED)
    until(lambda: fake.started)
    switch.close()
    assert fake.process.terminated
    until(lambda: not switch.compiling)
    assert current_engine() is REFERENCE
    assert fake.loaded == 0


def test_closed_before_it_begins_it_compiles_nothing(fake):
    switch = EngineSwitch()
    heard = told(switch)
    switch.close()
    switch.begin(COMPILED)
    until(lambda: heard and not switch.compiling)
    assert (fake.started, fake.loaded) == ([], 0)
    assert current_engine() is REFERENCE


def test_who_has_left_is_told_nothing(fake):
    fake.there = True
    switch, heard = EngineSwitch(), []
    leave = switch.subscribe(heard.append)
    others = told(switch)
    leave()
    switch.begin(COMPILED)
    until(lambda: others)
    assert heard == []


@pytest.fixture
def failed(fake, monkeypatch) -> list[str]:
    """What people were told when the compiler failed."""

    def failing() -> None:
        raise RuntimeError("no compiler")

    monkeypatch.setattr(readiness, "compile_all", failing)
    fake.process.done.set()
    switch = EngineSwitch()
    heard = told(switch)
    switch.begin(COMPILED)
    until(lambda: len(heard) == 2 and not switch.compiling)
    return [said for said, _ in heard]


def test_after_a_failure_the_reference_goes_on(failed, caplog):
    assert failed[0] == COMPILING
    assert "could not be compiled" in caplog.get_records("setup")[0].message
    assert current_engine() is REFERENCE


def test_a_failure_is_not_told_as_a_success(failed):
    assert COMPILED_NOW not in failed


def test_what_was_closed_is_not_told_as_compiled(fake):
    switch = EngineSwitch()
    heard = told(switch)
    switch.begin(COMPILED)
    until(lambda: fake.started)
    switch.close()
    until(lambda: not switch.compiling)
    assert COMPILED_NOW not in [said for said, _ in heard]
