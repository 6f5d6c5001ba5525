"""The --engine flag."""

import argparse

import pytest

from app.command_line import main
from app.commands.flags.engine_flags import add_engine_flag, choose_engine
from estimator import ENGINES, current_engine
from estimator.engine import readiness
from estimator.engines import COMPILED, REFERENCE
from tests.estimator.engines import using


def parsed(*arguments: str) -> str:
    parser = argparse.ArgumentParser()
    add_engine_flag(parser)
    return parser.parse_args(arguments).engine


def test_choices():
    assert parsed() == "compiled"
    assert [parsed("--engine", name) for name in ENGINES] == ["compiled", "reference"]


@pytest.mark.parametrize("command", ["view", "evaluate", "study", "export"])
def test_a_wrong_one_is_one_sentence(command: str, capsys: pytest.CaptureFixture[str]):
    with pytest.raises(SystemExit, match="2"):
        main([command, "--engine", "steam"])
    said = capsys.readouterr().err
    assert "'steam' (choose from 'compiled', 'reference')" in said
    assert said.count("\n") == 1


@pytest.fixture
def loaded(monkeypatch) -> list[str]:
    """Times that the compiled code was brought about; it is not there before."""
    times: list[str] = []
    monkeypatch.setattr(readiness, "is_compiled", lambda: bool(times))
    monkeypatch.setattr(readiness, "compile_all", lambda: times.append("loaded"))
    return times


def test_compiling_is_told_once_and_not_on_standard_output(loaded, capsys):
    with using(REFERENCE):
        choose_engine("compiled")
        assert current_engine() is COMPILED
        said = capsys.readouterr()
        assert said.out == ""
        assert said.err == "Compiling the estimator, once, in about half a minute.\n"
        choose_engine("compiled")
        assert capsys.readouterr().err == ""
    assert loaded == ["loaded", "loaded"]


def test_the_reference_compiles_nothing(loaded, capsys):
    with using(COMPILED):
        choose_engine("reference")
        assert current_engine() is REFERENCE
    assert loaded == []
    assert capsys.readouterr().err == ""
