"""Methods of a user's own, from a file."""

from pathlib import Path

import pytest

from app.analysis import method_files
from app.analysis.method_files import content_digest, is_method_file, load_method
from app.errors import InputError
from estimator import find_method, method_names

pytestmark = pytest.mark.usefixtures("methods_of_a_test")

FLOW = """
from estimator import scene_flow_of_points

def still(window, parameters):
    return scene_flow_of_points(window.source.points * float("nan"))
"""


@pytest.fixture
def file(tmp_path: Path) -> Path:
    path = tmp_path / "mine.py"
    path.write_text(FLOW)
    return path


def test_a_function_becomes_a_method(file: Path):
    assert load_method(f"{file}:still") == "mine-still"
    assert method_names()[-1] == "mine-still"
    assert find_method("mine-still").label == "mine.py:still"


def test_the_same_file_may_be_named_twice(file: Path, monkeypatch: pytest.MonkeyPatch):
    load_method(f"{file}:still")
    monkeypatch.chdir(file.parent)
    assert load_method("mine.py:still") == "mine-still"
    assert method_files.method_files(["paper", "mine-still"]) == (f"{file}:still",)


def test_a_method_of_a_taken_name_is_refused(tmp_path: Path):
    path = tmp_path / "taken.py"
    path.write_text("from estimator import Method\nM = Method('paper', lambda w, p: None)\n")
    with pytest.raises(InputError, match="There is a method paper already"):
        load_method(f"{path}:M")


@pytest.mark.parametrize(
    ("content", "said"),
    [
        ("x = 1", "has no method still; it must be a Method, or a function"),
        ("still = 3", "has no method still"),
        ("1 / 0", "cannot be run: ZeroDivisionError"),
        ("import (", "cannot be run: SyntaxError"),
    ],
)
def test_a_file_that_cannot_be_used_says_why(tmp_path: Path, content: str, said: str):
    path = tmp_path / "wrong.py"
    path.write_text(content)
    with pytest.raises(InputError, match=said):
        load_method(f"{path}:still")


def test_a_file_that_is_not_there_is_one_sentence(tmp_path: Path):
    with pytest.raises(InputError, match="There is no file"):
        load_method(f"{tmp_path}/nowhere.py:still")


def test_results_depend_on_the_files_content(file: Path):
    before = content_digest([f"{file}:still"])
    file.write_text(FLOW + "# changed\n")
    assert content_digest([f"{file}:still"]) != before
    assert content_digest([]) == ""


def test_a_registered_name_is_no_file():
    assert is_method_file("my/own.py:flow")
    assert not is_method_file("paper")
