import json
from pathlib import Path

import pytest

from app.command_line import main
from recordings import open_recording
from recordings.simulation import IMPERFECTIONS, NOISE_MODELS, SCENARIOS, Scenario
from tests.robot_assets.coarse_rig import COARSE_RIG

QUICK = ["--speed", "1", "--trial", "2", "--noise", "none"]


Asked = list[tuple[str, float, int]]


@pytest.fixture
def asked(monkeypatch: pytest.MonkeyPatch) -> Asked:
    """Scenario, speed and trial of each recording that is asked for; none is simulated."""
    found: Asked = []

    def write(path: Path, scenario: Scenario, *, speed: float, trial: int, **_: object) -> int:
        path.touch()
        found.append((scenario.name, speed, trial))
        return 1

    monkeypatch.setattr("app.commands.simulate.write_simulation", write)
    return found


def made(folder: Path) -> list[str]:
    return sorted(path.name for path in folder.iterdir())


def test_a_file_for_one_recording(tmp_path: Path, capsys: pytest.CaptureFixture[str]):
    out = tmp_path / "mine.mcap"
    assert main(["simulate", "sideways", *QUICK, "--seed", "9", "--out", str(out)]) == 0
    said = capsys.readouterr()
    assert said.err == ""
    assert len(said.out.splitlines()) == 1
    assert said.out.startswith(f"{out}: ")
    assert "frames" in said.out
    assert said.out.isascii()
    with open_recording(out) as recording:
        source = recording.provenance
        assert source is not None
        assert (source.scenario, source.speed, source.trial, source.seed) == ("sideways", 1.0, 2, 9)
        assert source.noise.startswith("none")


def test_a_file_without_speed_and_trial_is_one_recording(tmp_path: Path, asked: Asked):
    assert main(["simulate", "towards", "--out", str(tmp_path / "mine.mcap")]) == 0
    assert asked == [("towards", 0.25, 1)]


@pytest.mark.usefixtures("asked")
def test_a_folder_for_several(tmp_path: Path, capsys: pytest.CaptureFixture[str]):
    out = tmp_path / "new" / "folder"
    assert main(["simulate", "all", *QUICK, "--out", str(out)]) == 0
    assert made(out) == ["robot_moving_1.00_2.mcap", "sideways_1.00_2.mcap", "towards_1.00_2.mcap"]
    assert len(capsys.readouterr().out.splitlines()) == 3


def test_each_scenario_has_its_own_speeds(tmp_path: Path, asked: Asked):
    arguments = ["still", "crossing", "--trial", "1", "--out", str(tmp_path)]
    assert main(["simulate", *arguments]) == 0
    assert asked == [("still", 0.0, 1), ("crossing", 0.25, 1), ("crossing", 0.5, 1)]
    assert made(tmp_path) == ["crossing_0.25_1.mcap", "crossing_0.50_1.mcap", "still_0.00_1.mcap"]


def test_where_nothing_moves_the_speed_that_is_asked_for_is_for_the_others(
    tmp_path: Path, asked: Asked
):
    arguments = ["still", "fast", "--speed", "2", "--trial", "1"]
    assert main(["simulate", *arguments, "--out", str(tmp_path)]) == 0
    assert asked == [("still", 0.0, 1), ("fast", 2.0, 1)]
    assert made(tmp_path) == ["fast_2.00_1.mcap", "still_0.00_1.mcap"]


def test_imperfections_are_written_down(tmp_path: Path, capsys: pytest.CaptureFixture[str]):
    out = tmp_path / "mine.mcap"
    arguments = ["towards", *QUICK, "--imperfections", "ramps", "bias", "--out", str(out)]
    assert main(["simulate", *arguments]) == 0
    assert main(["info", str(out)]) == 0
    said = capsys.readouterr().out
    assert "\nimperfections bias, ramps\n" in said
    assert "--noise none --imperfections bias ramps --out mine.mcap\n" in said


def test_a_rig_of_ones_own_is_simulated_and_evaluated(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
):
    rig = tmp_path / "mine.toml"
    rig.write_text(COARSE_RIG)
    out = tmp_path / "out"
    assert main(["simulate", "towards", *QUICK, "--rig", str(rig), "--out", str(out)]) == 0
    assert made(out) == ["towards_1.00_2.mcap"]
    path = out / "towards_1.00_2.mcap"
    with open_recording(path) as recording:
        assert [(s.name, s.grid) for s in recording.sensors] == [
            ("left", (4, 4)),
            ("right", (4, 4)),
        ]
        assert recording.provenance is not None
        assert recording.provenance.rig == "two eyes"
    capsys.readouterr()
    table = tmp_path / "errors.json"
    few = ["--n", "2", "--n-min", "6", "--min-cluster-size", "2", "--delta", "0.02"]
    assert main(["evaluate", str(path), *few, "--json", str(table)]) == 0
    (row,) = json.loads(table.read_text())["recordings"]
    assert row["pairs"] > 0
    assert row["coverage"] is not None
    assert row["epe3d"] is not None


def test_a_rig_that_cannot_be_used_is_one_sentence_and_nothing_is_made(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
):
    out = tmp_path / "out"
    rig = tmp_path / "mine.toml"
    for wrong, said in [
        (("rows = 4", "rows = 1"), "sensor_model.rows must be a whole number from 2 to 64, got 1."),
        (("panda_hand", "wheel"), "fixes sensor right to link wheel, which the robot panda does"),
        (("[[sensors]]", "[[sensor]]"), "sensor is not a known key"),
    ]:
        rig.write_text(COARSE_RIG.replace(*wrong))
        assert main(["simulate", "towards", *QUICK, "--rig", str(rig), "--out", str(out)]) == 1
        errors = capsys.readouterr().err.strip().splitlines()
        assert len(errors) == 1
        assert said in errors[0]
    assert made(tmp_path) == ["mine.toml"]


def test_all_combinations_once(tmp_path: Path, asked: Asked):
    arguments = ["towards", "towards", "--speed", "1", "0.875", "1", "--trial", "1", "2"]
    assert main(["simulate", *arguments, "--out", str(tmp_path)]) == 0
    assert len(asked) == 4
    assert made(tmp_path) == [
        "towards_0.875_1.mcap",
        "towards_0.875_2.mcap",
        "towards_1.00_1.mcap",
        "towards_1.00_2.mcap",
    ]


def test_a_simulated_recording_is_replaced_and_nothing_else_is(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
):
    rig, out = tmp_path / "rig.toml", tmp_path / "towards_1.00_2.mcap"
    rig.write_text(COARSE_RIG)  # two sensors: soon done
    asked = ["simulate", "towards", *QUICK, "--rig", str(rig)]
    assert main([*asked, "--seed", "1", "--out", str(out)]) == 0
    first = out.read_bytes()
    assert main([*asked, "--seed", "2", "--out", str(tmp_path)]) == 0
    assert out.read_bytes() != first
    out.write_bytes(b"measured for weeks")
    assert main([*asked, "--out", str(tmp_path)]) == 1
    assert out.read_bytes() == b"measured for weeks"
    assert f"{out} exists and is not a simulated recording" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (["all", "--out", "x.mcap"], "x.mcap is a file, which holds one recording, and 3 are"),
        (["towards", "--trial", "1", "2", "--out", "x.mcap"], "and 2 are asked for"),
        (["towards", "--speed", "0", "--out", "x"], "--speed must be above 0.01 and at most 2 m/s"),
        (
            ["towards", "--speed", "nan", "--out", "x"],
            "--speed must be above 0.01 and at most 2 m/s",
        ),
        (["towards", "--trial", "0", "--out", "x"], "--trial must be 1 or more, got 0"),
        (["towards", "--seed", "-1", "--out", "x"], "--seed must be 0 or more, got -1"),
        (["towards", "--out", "no/where/x.mcap"], "no/where/x.mcap cannot be written"),
        (["towards", "--out", "taken/inside"], "The folder taken/inside cannot be made"),
    ],
)
def test_wrong_arguments_are_one_sentence(
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
    arguments: list[str],
    said: str,
):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "taken").write_text("a file")
    assert main(["simulate", *arguments]) == 1
    errors = capsys.readouterr().err.strip().splitlines()
    assert len(errors) == 1
    assert said in errors[0]
    assert made(tmp_path) == ["taken"]


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (["backwards", "--out", "x"], "towards"),
        (["towards"], "--out"),
        (["towards", "--out", "x", "--noise", "loud"], "paper"),
        (["towards", "--out", "x", "--imperfections", "rust"], "bias"),
    ],
)
def test_unknown_names_are_one_sentence_that_lists_the_known(
    capsys: pytest.CaptureFixture[str], arguments: list[str], said: str
):
    with pytest.raises(SystemExit) as stop:
        main(["simulate", *arguments])
    assert stop.value.code == 2
    errors = capsys.readouterr().err.strip().splitlines()
    assert len(errors) == 1
    assert said in errors[0]


def test_help_says_what_happens_to_files_that_exist(capsys: pytest.CaptureFixture[str]):
    with pytest.raises(SystemExit) as stop:
        main(["simulate", "--help"])
    assert stop.value.code == 0
    text = " ".join(capsys.readouterr().out.split())
    assert "exists under the name is replaced" in text
    for name in [*SCENARIOS, *NOISE_MODELS, *IMPERFECTIONS, "all", "more", "8 to 11 %"]:
        assert name in text


@pytest.mark.parametrize(
    ("flags", "said"),
    [
        (["--pose-rate", "100"], "--pose-rate needs --duration."),
        (["--duration", "0"], "--duration must be above 0 and at most 86400 s, got 0."),
        (["--duration", "nan"], "--duration must be above 0 and at most 86400 s, got nan."),
        (["--duration", "9", "--pose-rate", "-1"], "--pose-rate must be 0 to 1000 Hz, got -1."),
    ],
)
def test_a_repetition_that_cannot_be_is_one_sentence(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], flags: list[str], said: str
):
    assert main(["simulate", "towards", *flags, "--out", str(tmp_path / "x.mcap")]) != 0
    assert said in capsys.readouterr().err


def test_a_recording_of_a_duration_lasts_so_long(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
):
    rig = tmp_path / "rig.toml"
    rig.write_text(COARSE_RIG)
    flags = ["--duration", "4", "--pose-rate", "50", "--rig", str(rig)]
    assert main(["simulate", "towards", *QUICK, *flags, "--out", str(tmp_path / "x.mcap")]) == 0
    assert "60 frames" in capsys.readouterr().out
