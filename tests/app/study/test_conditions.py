"""Commands and captions that say how a study was made."""

import shlex
from dataclasses import replace
from pathlib import Path

import pytest

from app.analysis.method_files import load_method
from app.study.conditions import definitions, parameters_text, study_command
from estimator import METRIC_INFO, PARAMETER_INFO, Parameters
from tests.app.study.made import PLAN
from tests.conftest import REPOSITORY


def test_the_command_has_what_differs_from_the_defaults():
    parameters = Parameters(gamma=0.6, min_samples=5, allow_single_cluster=True)
    words = shlex.split(study_command(replace(PLAN, parameters=parameters)))
    assert words[words.index("--gamma") + 1] == "0.6"
    assert words[words.index("--min-samples") + 1] == "5"
    assert "--allow-single-cluster" in words
    assert "--delta" not in words


@pytest.mark.usefixtures("methods_of_a_test")
def test_a_method_from_a_file_is_given_as_its_file():
    file: Path = REPOSITORY / "tests" / "own_methods.py"
    name = load_method(f"{file}:CENTROID")
    words = shlex.split(study_command(replace(PLAN, methods=("paper", name))))
    first = words.index("--method") + 1
    assert words[first : first + 2] == ["paper", f"{file}:CENTROID"]


def test_every_parameter_of_the_methods_is_said():
    said = parameters_text(PLAN)
    for name in PARAMETER_INFO.keys() - {"method"}:
        assert f"{name} = " in said


def test_definitions_are_those_of_the_metrics():
    said = definitions(("pairs", "coverage"))
    assert said == f"{METRIC_INFO['coverage'].described}."
