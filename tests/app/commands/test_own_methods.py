"""Methods of a user's own in `evaluate` and `study`, with nothing changed for them."""

import json
from pathlib import Path

import pytest

from app.command_line import main
from tests.conftest import REPOSITORY
from tests.recordings.room import write_room

FILE = REPOSITORY / "tests" / "own_methods.py"
ALONG_RAYS, TRACKER = f"{FILE}:RANGE_RATE", f"{FILE}:CENTROID"


@pytest.fixture(scope="module")
def rooms(tmp_path_factory: pytest.TempPathFactory) -> list[str]:
    """Two recordings of a board that comes nearer."""
    folder = tmp_path_factory.mktemp("rooms")
    return [str(write_room(folder / f"{k}.mcap", frames=14, seed=k).path) for k in (1, 2)]


@pytest.mark.parametrize("method", [ALONG_RAYS, TRACKER])
def test_evaluate_runs_it(method: str, rooms: list[str], tmp_path: Path, methods_of_a_test):
    out = tmp_path / "out.json"
    assert main(["evaluate", rooms[0], "--method", method, "--json", str(out)]) == 0
    content = json.loads(out.read_text())
    assert content["recordings"][0]["points_with_flow"] > 1000
    assert content["parameters"]["method"] in content["parameters"]


def test_its_parameters_are_flags_and_change_its_results(
    rooms: list[str], tmp_path: Path, methods_of_a_test
):
    found = []
    for flags in ([], ["--range-rate-slowest", "0.3", "--no-range-rate-robust"]):
        out = tmp_path / "out.json"
        command = ["evaluate", rooms[0], "--method", ALONG_RAYS]
        assert main([*command, *flags, "--json", str(out)]) == 0
        content = json.loads(out.read_text())
        found.append(content["recordings"][0]["points_with_flow"])
    assert found[1] < found[0]
    assert content["parameters"]["range-rate"] == {"slowest": 0.3, "robust": False}
    saved = tmp_path / "saved.json"
    saved.write_text(out.read_text())
    again = ["evaluate", rooms[0], "--method", ALONG_RAYS, "--json", str(out)]
    assert main([*again, "--parameters", str(saved)]) == 0
    assert json.loads(out.read_text())["recordings"] == content["recordings"]


def test_a_value_out_of_range_names_the_flag(
    rooms: list[str], methods_of_a_test, capsys: pytest.CaptureFixture[str]
):
    command = ["evaluate", rooms[0], "--method", TRACKER]
    assert main([*command, "--centroid-memory", "0"]) == 1
    assert "centroid.memory must be between 1 and 100 steps, got 0." in capsys.readouterr().err


@pytest.mark.parametrize("jobs", ["1", "2"])
def test_a_study_compares_them_in_any_number_of_processes(
    jobs: str, rooms: list[str], tmp_path: Path, methods_of_a_test
):
    command = ["study", "--recordings", *rooms, "--jobs", jobs, "--sweep"]
    methods = ["--method", "baseline", ALONG_RAYS, TRACKER, "--centroid-memory", "3"]
    assert main([*command, *methods, "--out", str(tmp_path)]) == 0
    tables = json.loads((tmp_path / "tables" / "tables.json").read_text())
    rows = tables["tables"]["recordings"]
    assert {row["method"] for row in rows} == {"baseline", "range-rate", "centroid"}
    assert all(row["points_with_flow"] > 1000 for row in rows)
    assert tables["parameters"]["centroid"] == {"memory": 3}
    page = (tmp_path / "index.html").read_text()
    assert "centroid.memory = 3 steps" in page
    assert f"digest {tables['software'][:16]}" in page


FAILING = """
from dataclasses import dataclass
from estimator import CheckedParameters, Method, parameter

def boom(window, parameters):
    raise ValueError("boom")

@dataclass(frozen=True)
class Colliding(CheckedParameters):
    samples: int = parameter(1, text="samples")

MIN = Method("min", boom, parameters=Colliding)
"""


@pytest.mark.parametrize(
    ("name", "said"),
    [
        ("boom", "Method mine-boom failed (ValueError: boom)"),
        ("MIN", "Method min cannot have the flag --min-samples"),
    ],
)
def test_what_is_wrong_with_a_method_of_ones_own_is_a_sentence(
    name: str,
    said: str,
    rooms: list[str],
    tmp_path: Path,
    methods_of_a_test,
    capsys: pytest.CaptureFixture[str],
):
    (tmp_path / "mine.py").write_text(FAILING)
    command = ["evaluate", rooms[0], "--method", f"{tmp_path}/mine.py:{name}"]
    assert main(command) != 0
    assert said in capsys.readouterr().err
