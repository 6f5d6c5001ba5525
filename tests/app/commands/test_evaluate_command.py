import json
import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from rich.cells import cell_len

from app.command_line import main
from estimator import METRIC_INFO
from tests.app.terminal.screen import Screen
from tests.estimator.judge import judge
from tests.recordings.foreign import ForeignFile, image
from tests.recordings.room import Room, write_room


def by_hand(room: Room, gate: bool) -> dict[str, float]:
    """The paper's errors of a room, by the judge and plain loops."""
    angles, errors = [], []
    for k in range(8, len(room.points)):
        source, target = room.points[k - 8], room.points[k]
        interval = (room.stamps[k] - room.stamps[k - 8]) * 1e-9
        _, velocity = judge(source, target, interval, gate=gate)
        for v in velocity[np.isfinite(velocity).all(axis=1)]:
            cosine = v @ room.velocity / (np.linalg.norm(v) * np.linalg.norm(room.velocity))
            angles.append(np.degrees(np.arccos(np.clip(cosine, -1, 1))))
            errors.append(np.linalg.norm(v - room.velocity))
    return {
        "points_with_flow": len(angles),
        "angle_deg": float(np.mean(angles)),
        "velocity_error": float(np.mean(errors)),
    }


@pytest.mark.parametrize(("method", "gate"), [("paper", True), ("baseline", False)])
def test_errors_are_those_of_an_independent_implementation(
    tmp_path: Path, method: str, gate: bool, capsys: pytest.CaptureFixture[str]
):
    room = write_room(tmp_path / "room.mcap", frames=12)
    table = tmp_path / "table.json"
    assert main(["evaluate", str(room.path), "--method", method, "--json", str(table)]) == 0
    content = json.loads(table.read_text())
    row = content["recordings"][0]
    assert content["parameters"]["method"] == method
    assert row["pairs"] == 4
    assert row["coverage"] is row["precision"] is row["epe3d"] is row["scenario"] is None
    expected = by_hand(room, gate)
    assert row["acc_s"] is row["dynamic_iou"] is row["false_flow"] is None
    assert expected["points_with_flow"] > 100
    assert {key: row[key] for key in expected} == pytest.approx(expected, rel=1e-6)
    assert "room" in capsys.readouterr().out


def by_hand_of_every_point(room: Room, **judged: Any) -> dict[str, float]:
    """The field's metrics of a room from their definitions, point after point."""
    listed: dict[str, list[float]] = {}

    def note(name: str, value: float) -> None:
        listed.setdefault(name, []).append(value)

    for k in range(8, len(room.points)):
        interval = (room.stamps[k] - room.stamps[k - 8]) * 1e-9
        label, velocity = judge(room.points[k - 8], room.points[k], interval, **judged)
        for i in range(len(label)):
            flows = label[i] == 2
            moves = room.on_board[k - 8][i] and k >= room.rests
            if not moves:
                note("false_flow", flows)
            if k - 8 < room.rests:
                continue  # the board rests at frame k - 8: the pair does not count
            way = room.velocity * interval if moves else np.zeros(3)
            found = velocity[i] * interval if flows else np.zeros(3)
            error = float(np.sqrt(((found - way) ** 2).sum()))
            relative = error / (float(np.sqrt((way**2).sum())) + 1e-4)
            note("epe3d", error)
            note("acc_s", error < 0.05 or relative < 0.05)
            note("acc_r", error < 0.1 or relative < 0.1)
            note("outliers", error > 0.3 or relative > 0.1)
            if moves:
                note("coverage", flows)
            if flows:
                note("precision", moves)
            if flows or moves:
                note("dynamic_iou", flows and moves)
    return {name: float(np.mean(values)) for name, values in listed.items()}


@pytest.mark.parametrize(
    ("flags", "judged"),
    [
        (["--method", "paper"], {}),
        (["--method", "baseline"], {"gate": False}),
        (["--n-min", "130", "--delta", "0.01"], {"n_min": 130, "delta": 0.01}),
    ],
    ids=["the board alone is flagged", "everything is", "only the walls are"],
)
def test_metrics_of_points_are_those_of_an_independent_implementation(
    tmp_path: Path, flags: list[str], judged: dict[str, Any]
):
    room = write_room(tmp_path / "room.mcap", frames=16, rests=4, tells_points=True)
    table = tmp_path / "table.json"
    assert main(["evaluate", str(room.path), *flags, "--json", str(table)]) == 0
    row = json.loads(table.read_text())["recordings"][0]
    expected = by_hand_of_every_point(room, **judged)
    assert row["pairs"] == 4
    assert {key: row[key] for key in expected} == pytest.approx(expected, rel=1e-5)


def test_columns_stand_below_their_titles_whatever_a_recording_is_called(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
):
    write_room(tmp_path / "room.mcap", frames=9, tells_points=True)
    write_room(tmp_path / "a_room_with_a_rather_long_name.mcap", frames=9, tells_points=True)
    assert main(["evaluate", str(tmp_path)]) == 0
    *above, titles, first, second = capsys.readouterr().out.splitlines()
    assert [titles.split()[0], *(line.split()[0] for line in (first, second))] == [
        "recording",
        "a_room_with_a_rather_long_name",
        "room",
    ]
    ends = [[m.end() for m in re.finditer(r"\S+", line)][1:] for line in (titles, first, second)]
    assert ends[0] == ends[1] == ends[2]
    assert len(ends[0]) == len(METRIC_INFO)
    assert any("velocity" in line for line in above)
    assert max(map(len, above)) <= len(titles)


def test_rows_come_one_by_one_above_a_bar_at_a_terminal(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
):
    for name in ("one", "two"):
        write_room(tmp_path / f"{name}.mcap", frames=9, tells_points=True)
    asked = ["evaluate", str(tmp_path), "--jobs", "1"]
    assert main(asked) == 0
    plain = capsys.readouterr().out
    assert "\x1b" not in plain

    monkeypatch.setattr("sys.stdout.isatty", lambda: True)
    monkeypatch.setenv("TERM", "xterm-256color")
    monkeypatch.setenv("COLUMNS", "60")
    assert main(asked) == 0
    written = capsys.readouterr().out
    screen = Screen(written, 200)
    assert screen.lines == plain.splitlines()
    assert screen.cursor_visible
    *_, above, bar = Screen(written[: written.rindex("\x1b[2K")], 200).lines
    assert above.startswith("one ")
    assert re.fullmatch(r"1/2 \S+ +two +", bar.ljust(60))


def test_names_of_files_do_a_terminal_no_harm(tmp_path: Path, capsys: pytest.CaptureFixture[str]):
    write_room(tmp_path / "a\x1b[31m表.mcap", frames=9)
    (tmp_path / "b\nc.mcap").write_bytes(b"nonsense")
    assert main(["evaluate", str(tmp_path)]) == 0
    out, err = capsys.readouterr()
    *_, first, second = out.splitlines()
    assert first.startswith(r"a\x1b[31m表 ")
    assert second.startswith(r"b\nc ")
    # A sign of two columns takes two.
    assert cell_len(first[: first.index(" 1 ")]) == second.index(" - ")
    assert r"b\nc.mcap is not an MCAP file" in err
    assert err.count("\n") == 1


def test_where_nothing_moves_the_false_flow_is_known_alone(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
):
    room = write_room(tmp_path / "room.mcap", frames=10, rests=10, tells_points=True)
    table = tmp_path / "table.json"
    flags = ["--method", "baseline", "--json", str(table)]
    assert main(["evaluate", str(room.path), *flags]) == 0
    row = json.loads(table.read_text())["recordings"][0]
    assert row["pairs"] == row["points_with_flow"] == 0
    assert row["false_flow"] > 0.9
    assert row["angle_deg"] is row["epe3d"] is row["coverage"] is row["dynamic_iou"] is None
    assert "no pair that counts" in (said := capsys.readouterr().err)
    assert "Only the false flow is known." in said


def test_a_recording_without_truth_gets_a_row_of_nulls_and_a_warning(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
):
    file = ForeignFile()
    for k in range(3):
        message = image(k * 66_000_000, "eye", np.full((8, 8), 900, "<u2"), "16UC1")
        file.add("/eye/image", "sensor_msgs/msg/Image", message, k)
    blind = file.write(tmp_path / "blind.mcap")
    table = tmp_path / "table.json"
    assert main(["evaluate", str(blind), "--json", str(table)]) == 1
    row = json.loads(table.read_text())["recordings"][0]
    assert row["path"] == str(blind)
    assert all(value is None for key, value in row.items() if key != "path")
    assert "blind.mcap has no truth" in capsys.readouterr().err

    room = write_room(tmp_path / "room.mcap", frames=9).path
    assert main(["evaluate", str(blind), str(room)]) == 0


def test_a_folder_is_all_its_recordings_and_a_bad_one_does_not_stop_the_rest(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
):
    write_room(tmp_path / "good.mcap", frames=9)
    (tmp_path / "bad.mcap").write_bytes(b"nonsense")
    table = tmp_path / "out" / "table.json"
    table.parent.mkdir()
    assert main(["evaluate", str(tmp_path), "--json", str(table)]) == 0
    rows = json.loads(table.read_text())["recordings"]
    assert [Path(row["path"]).stem for row in rows] == ["bad", "good"]
    assert rows[0]["pairs"] is None
    assert rows[1]["pairs"] == 1
    assert "not an MCAP file" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (["nowhere.mcap"], "There is no file or folder nowhere.mcap"),
        ([".", "--n", "0"], "n must be between 1 and 1000 frames, got 0"),
        ([".", "--gamma", "1.5"], "gamma must be between 0 and 1, got 1.5"),
        ([".", "--rig", "nothing.toml"], "nothing.toml cannot be read"),
        ([".", "--urdf", "nothing.urdf"], "nothing.urdf cannot be read"),
        ([".", "--json", "nowhere/table.json"], "nowhere/table.json cannot be written"),
    ],
)
def test_wrong_arguments_are_one_sentence(
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
    arguments: list[str],
    said: str,
):
    write_room(tmp_path / "room.mcap", frames=2)
    monkeypatch.chdir(tmp_path)
    assert main(["evaluate", *arguments]) == 1
    last = capsys.readouterr().err.strip().splitlines()[-1]
    assert last.startswith("tofscope evaluate: ")
    assert said in last


def test_unknown_flags_are_one_sentence(capsys: pytest.CaptureFixture[str]):
    with pytest.raises(SystemExit) as stop:
        main(["evaluate", ".", "--nonsense"])
    assert stop.value.code == 2
    assert len(capsys.readouterr().err.strip().splitlines()) == 1


def test_two_arms_with_equal_ends_of_topics_give_the_right_answer(
    shared_data: Path, tmp_path: Path
):
    path = shared_data / "cases" / "f11_two_arms_equal_topic_tails.mcap"
    table = tmp_path / "table.json"
    assert main(["evaluate", str(path), "--json", str(table)]) == 0
    (row,) = json.loads(table.read_text())["recordings"]
    assert (row["pairs"], row["points_with_flow"]) == (32, 3732)
    assert row["angle_deg"] == pytest.approx(0.68, abs=0.005)
    assert row["velocity_error"] == pytest.approx(0.0022, abs=0.00005)
