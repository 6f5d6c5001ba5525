import csv
import json
import re
import shutil
from pathlib import Path

import numpy as np
import pytest

from app.command_line import main
from app.errors import InputError
from tests.recordings.foreign import ForeignFile, image
from tests.recordings.room import write_room

TINY = ["--speed", "0.3", "--trial", "1", "--scenario", "towards", "--sweep", "8", "10"]
EVERY = ["table_1", "metrics", "sweep", "recordings"]


def study(out: Path, *arguments: str) -> int:
    return main(["study", "--out", str(out), "--jobs", "1", *arguments])


@pytest.fixture(scope="module")
def tiny(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A study of one recording."""
    out = tmp_path_factory.mktemp("study")
    assert study(out, *TINY) == 0
    return out


def test_a_study_leaves_tables_figure_and_a_page_to_read_first(tiny: Path):
    for name in EVERY:
        for ending in ("csv", "md", "tex"):
            assert (tiny / "tables" / f"{name}.{ending}").stat().st_size > 100
    # Of Table II there is no recording.
    assert {path.stem for path in (tiny / "tables").glob("*.csv")} == set(EVERY)
    assert (tiny / "sweep.png").read_bytes().startswith(b"\x89PNG")
    assert (tiny / "sweep.pdf").read_bytes().startswith(b"%PDF")
    text = (tiny / "index.html").read_text("utf-8")
    assert "Everything here is simulated" in text
    assert "tofscope simulate towards --speed 0.3 --trial 1 --seed 0 --noise paper" in text
    for link in re.findall(r'href="([^"]+)"', text):
        assert (tiny / link).is_file()


def test_tables_hold_what_evaluate_finds_on_the_same_recording(tiny: Path, tmp_path: Path):
    file, found = tmp_path / "a.mcap", tmp_path / "a.json"
    asked = ["towards", "--speed", "0.3", "--trial", "1", "--out", str(file)]
    assert main(["simulate", *asked]) == 0
    assert main(["evaluate", str(file), "--json", str(found)]) == 0
    expected = json.loads(found.read_text())["recordings"][0]
    with (tiny / "tables" / "table_1.csv").open(encoding="utf-8") as lines:
        (row,) = (
            r for r in csv.DictReader(lines) if r["trials"] == "1/1" and "1)" in r["experiment"]
        )
    assert float(row["angle_mean"]) == expected["angle_deg"]
    assert float(row["velocity_mean"]) == expected["velocity_error"]
    assert float(row["coverage"]) == expected["coverage"]
    assert float(row["paper_angle_mean"]) == 10.313

    # And so do recordings that are given: the same tables, from files.
    given = tmp_path / "given"
    assert study(given, "--recordings", str(file), "--sweep", "8", "10") == 0
    ours, theirs = (
        json.loads((folder / "tables" / "tables.json").read_text())["tables"]
        for folder in (tiny, given)
    )
    for name in ("table_1", "metrics", "sweep"):
        assert ours[name] == theirs[name]
    assert "no recordings at 0.15, 0.20, 0.25 m/s here" in (given / "index.html").read_text()


def test_what_another_study_left_in_the_folder_is_no_part_of_this_one(tiny: Path, tmp_path: Path):
    shutil.copytree(tiny, tmp_path / "out")
    (tmp_path / "out" / "tables" / "mine.csv").write_text("kept")
    assert study(tmp_path / "out", *TINY[:-2]) == 0
    left = {path.name for path in (tmp_path / "out").rglob("*") if path.is_file()}
    assert not {name for name in left if name.startswith("sweep")}
    assert {"index.html", "table_1.tex", "mine.csv"} <= left


def test_the_same_command_finds_all_done(tiny: Path, capsys: pytest.CaptureFixture[str]):
    before = (tiny / "tables" / "tables.json").read_bytes()
    assert study(tiny, *TINY) == 0
    printed = capsys.readouterr().out
    assert "1 of 1 recordings are known from before." in printed
    assert "left" not in printed.split("Table")[0]
    assert (tiny / "tables" / "tables.json").read_bytes() == before


def test_a_broken_recording_and_one_without_truth_do_not_lose_the_rest(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "in").mkdir()
    blind = ForeignFile()
    for k in range(3):
        message = image(k * 66_000_000, "eye", np.full((8, 8), 900, "<u2"), "16UC1")
        blind.add("/eye/image", "sensor_msgs/msg/Image", message, k)
    blind.write(tmp_path / "in" / "blind.mcap")
    room = write_room(tmp_path / "in" / "room.mcap", frames=12)
    shutil.copy(room.path, tmp_path / "in" / "same.mcap")
    (tmp_path / "in" / "broken.mcap").write_bytes(b"nonsense")
    out = tmp_path / "out"
    assert study(out, "--recordings", "in", "--sweep") == 0
    # Wherever a worker runs it finds them.
    kept = [json.loads(path.read_text()) for path in (out / "results").glob("*.json")]
    assert str(room.path) in {content["source"]["path"] for content in kept}
    said = capsys.readouterr()
    assert "Not evaluated:" in said.err
    assert "not an MCAP file" in said.err
    assert "blind has no truth" in said.err
    assert "same has the same content as room, and counts once." in said.err
    text = (out / "index.html").read_text("utf-8")
    assert "not an MCAP file" in text
    assert "blind has no truth" in text
    with (out / "tables" / "recordings.csv").open(encoding="utf-8") as lines:
        rows = list(csv.DictReader(lines))
    assert [(row["recording"], row["method"]) for row in rows] == [
        ("blind", "paper"),
        ("blind", "baseline"),
        (room.path.stem, "paper"),
        (room.path.stem, "baseline"),
    ]
    assert float(rows[2]["angle_deg"]) < 90
    assert not (out / "sweep.png").exists()
    # Nothing of the paper's is among them: no empty tables.
    assert sorted(path.stem for path in (out / "tables").glob("*.csv")) == ["recordings"]
    assert "None of the paper&#x27;s experiments is among these recordings." in text
    assert room.path.stem in said.out.split("Every recording")[1]


def test_a_result_that_cannot_be_kept_does_not_end_the_study(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
):
    def full(path: Path, _: bytes) -> None:
        raise InputError(f"{path} cannot be written: No space left on device.")

    room = write_room(tmp_path / "room.mcap", frames=12)
    monkeypatch.setattr("app.study.store.write", full)
    assert study(tmp_path / "out", "--recordings", str(room.path), "--sweep") == 0
    said = capsys.readouterr().err.splitlines()
    assert [line.partition(":")[0] for line in said] == ["Result not stored for later runs"]
    assert said[0].endswith("cannot be written: No space left on device.")
    assert "room" in (tmp_path / "out" / "tables" / "recordings.csv").read_text()


def test_where_a_frames_motion_is_the_truth_it_is_said_below_the_table(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
):
    room = write_room(tmp_path / "room.mcap", frames=12)
    asked = ["--recordings", str(room.path), "--sweep", "--truth-frame"]
    assert study(tmp_path / "out", *asked, "skin_0") == 0
    below = capsys.readouterr().out.split("Every recording")[1]
    assert "move with the frame skin_0: precision is 1 by construction" in below


def test_where_nothing_could_be_evaluated_the_exit_code_is_1(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
):
    (tmp_path / "broken.mcap").write_bytes(b"nonsense")
    out = tmp_path / "out"
    assert study(out, "--recordings", str(tmp_path / "broken.mcap")) == 1
    assert "not an MCAP file" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("arguments", "sentence"),
    [
        (["--recordings", ".", "--noise", "paper"], "--noise says how recordings are simulated"),
        (["--truth-frame", "panel"], "--truth-frame says how recordings are opened"),
        (["--jobs", "0"], "--jobs must be 1 or more"),
        (["--sweep", "0"], "n must be between"),
        (["--trial", "0"], "--trial must be 1 or more"),
        (["--speed", "-1"], "--speed must be above 0.01 and at most 2 m/s, got -1."),
        (["--speed", "0.0001"], "--speed must be above 0.01 and at most 2 m/s, got 0.0001."),
        (["--speed", "inf"], "--speed must be above 0.01 and at most 2 m/s, got inf."),
        (["--seed", "-1"], "--seed must be 0 or more"),
        (["--recordings", "nowhere"], "no file or folder nowhere"),
    ],
)
def test_what_makes_no_sense_is_refused_in_one_sentence(
    tmp_path: Path, arguments: list[str], sentence: str, capsys: pytest.CaptureFixture[str]
):
    assert main(["study", "--out", str(tmp_path / "out"), *arguments]) == 1
    said = capsys.readouterr().err
    assert sentence in said
    assert said.count("\n") == 1
    assert not (tmp_path / "out").exists()
