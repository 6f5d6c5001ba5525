"""Studies simulated with a rig of one's own, which is small here."""

import json
from pathlib import Path

import pytest

from app.command_line import main
from tests.robot_assets.coarse_rig import COARSE_RIG


@pytest.fixture
def rig(tmp_path: Path) -> Path:
    path = tmp_path / "coarse.toml"
    path.write_text(COARSE_RIG)
    return path


def study(out: Path, rig: Path, *arguments: str) -> int:
    """Study one recording, without the sweep of n."""
    asked = ["--speed", "0.3", "--trial", "1", "--scenario", "towards", "--rig", str(rig)]
    return main(["study", "--out", str(out), "--jobs", "1", "--sweep", *asked, *arguments])


def test_a_study_simulates_with_a_rig_of_ones_own_and_says_so(tmp_path: Path, rig: Path):
    out = tmp_path / "out"
    assert study(out, rig) == 0
    assert "with the rig coarse.toml" in (out / "index.html").read_text("utf-8")
    assert "rig coarse.toml, noise model" in (out / "tables" / "metrics.md").read_text("utf-8")
    assert f"--rig {rig}" in (out / "index.html").read_text("utf-8")
    tables = json.loads((out / "tables" / "tables.json").read_text("utf-8"))
    assert tables["rig"] == "coarse.toml"
    [kept] = (out / "results").glob("*.json")
    rig.write_text(COARSE_RIG.replace("60.0", "45.0"))
    assert study(out, rig) == 0
    assert len(list((out / "results").glob("*.json"))) == 2, f"{kept} was taken for another rig's"


def test_a_rig_that_cannot_be_used_ends_a_study_before_it_begins(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
):
    assert study(tmp_path / "out", tmp_path / "none.toml") == 1
    assert "cannot be read as a rig file" in capsys.readouterr().err


def test_the_second_command_on_the_page_is_whole(tmp_path: Path, rig: Path):
    asked = ["--method", "paper", "--gamma", "0.6", "--allow-single-cluster"]
    assert study(tmp_path / "out", rig, *asked) == 0
    assert (
        "tofscope study --recordings recordings --method paper --sweep --gamma 0.6 "
        "--allow-single-cluster --out FOLDER"
    ) in (tmp_path / "out" / "index.html").read_text("utf-8")
