import argparse
from pathlib import Path

import pytest

from app.analysis.parameter_files import to_text
from app.command_line import main
from app.commands.flags.parameter_flags import add_parameter_flags, parameters_from
from app.errors import InputError
from estimator import PARAMETER_INFO, ParameterError, Parameters


def parsed(*arguments: str) -> Parameters:
    parser = argparse.ArgumentParser()
    add_parameter_flags(parser)
    return parameters_from(parser.parse_args(arguments))


def test_without_flags_the_defaults_hold():
    assert parsed() == Parameters()


def test_every_field_is_a_flag_of_its_own_name():
    values = {"method": "baseline"} | {
        name: not info.default if info.kind is bool else info.kind(info.low + 1)
        for name, info in PARAMETER_INFO.items()
        if name != "method"
    }
    flags: list[str] = []
    for name, value in values.items():
        flag = "--" + name.replace("_", "-")
        flags += [flag] if value is True else [flag, str(value)]
    assert parsed(*flags) == Parameters(**values)  # type: ignore[arg-type]
    assert parsed("--no-allow-single-cluster") == Parameters()


def test_flags_out_of_range_are_refused():
    with pytest.raises(ParameterError, match="delta must be between 0 and 10 m, got -1"):
        parsed("--delta", "-1")


def test_flags_win_over_a_file(tmp_path: Path):
    path = tmp_path / "mine.json"
    path.write_text(to_text(Parameters(n=3, gamma=0.5)))
    assert parsed("--parameters", str(path)) == Parameters(n=3, gamma=0.5)
    assert parsed("--parameters", str(path), "--n", "8") == Parameters(n=8, gamma=0.5)


def test_a_file_that_is_not_there_is_one_sentence(tmp_path: Path):
    with pytest.raises(InputError, match=r"^There is no file .*none\.json; check the spelling\.$"):
        parsed("--parameters", str(tmp_path / "none.json"))


def test_a_number_of_another_kind_is_said_in_words(capsys: pytest.CaptureFixture[str]):
    for flag, text, kind in (("--n", "2.5", "a whole number"), ("--delta", "far", "a number")):
        with pytest.raises(SystemExit):
            main(["evaluate", "x.mcap", flag, text])
        assert f"argument {flag}: must be {kind}, got '{text}'" in capsys.readouterr().err


def test_flags_are_written_in_full(capsys: pytest.CaptureFixture[str]):
    with pytest.raises(SystemExit):
        main(["evaluate", "x.mcap", "--metho", "paper"])
    assert "unrecognized arguments: --metho paper" in capsys.readouterr().err
