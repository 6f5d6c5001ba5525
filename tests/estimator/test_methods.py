"""Methods by name."""

import subprocess
import sys

import pytest

from estimator import PARAMETER_INFO, find_method, method_names
from estimator.baseline import baseline
from estimator.paper import algorithm_1


def test_the_papers_method_comes_first():
    assert method_names()[:2] == ("paper", "baseline")


def test_a_name_leads_to_its_function():
    assert find_method("paper").flow is algorithm_1
    assert find_method("baseline").flow is baseline


def test_there_is_no_method_of_another_name():
    with pytest.raises(KeyError):
        find_method("")


def test_naming_the_methods_loads_neither_open3d_nor_scikit_learn():
    code = (
        "import sys, estimator; estimator.Parameters(method='baseline');"
        "sys.exit(bool({'open3d', 'sklearn'} & set(sys.modules)))"
    )
    assert subprocess.run([sys.executable, "-c", code], check=False).returncode == 0


def test_every_parameter_is_one_of_algorithm_1():
    """So that a new field of `Parameters` has a control on the page without a further list."""
    assert set(find_method("paper").infos()) == set(PARAMETER_INFO) - {"method"}
    added = set(find_method("paper").infos()) - set(find_method("baseline").infos())
    assert added == {"gamma", "delta"}
