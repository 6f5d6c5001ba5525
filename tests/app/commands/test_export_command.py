import os
import sys

import numpy as np
import pytest

from app.command_line import main
from recordings import sample_paths
from tests.recordings.room import write_room


def refusal(capsys, *arguments) -> tuple[int, str]:
    """Run `tofscope export`, which must refuse; its exit code and its one line of complaint."""
    try:
        code = main(["export", *map(str, arguments)])
    except SystemExit as error:
        code = int(error.code or 0)
    captured = capsys.readouterr()
    assert captured.out == ""
    assert captured.err.count("\n") == 1
    return code, captured.err


@pytest.fixture
def room(tmp_path):
    return write_room(tmp_path / "room.mcap", frames=3).path


@pytest.mark.parametrize(
    ("arguments", "code", "said"),
    [
        (
            [],
            2,
            "one of the arguments --screenshot --vector --video --images --html --flow --plots",
        ),
        (["--screenshot", "a.png", "--html", "a.html"], 2, "not allowed with argument"),
        (["--screenshot", "a.png", "--size", "1600"], 2, "a size is written 1600x900"),
        (["--screenshot", "a.png", "--size", "9x900"], 2, "each side from 16 to 4096"),
        (["--html", "a.html", "--frames", "3"], 2, "frames are written FIRST:LAST"),
        (["--screenshot", "a.png", "--view", "side"], 2, "invalid choice: 'side'"),
        (["--screenshot", "a.png", "--frame", "3"], 1, "room has no frame 3: its frames are 0 to"),
        (["--screenshot", "a.png", "--frame", "-1"], 1, "room has no frame -1"),
        (["--html", "a.html", "--frames", ":9"], 1, "room has no frame 9"),
        (["--html", "a.html", "--frames", "2:1"], 1, "must not be before the first; got 2:1"),
        (["--html", "a.html", "--frame", "9"], 1, "room has no frame 9"),
        (
            ["--html", "a.html", "--frame", "0", "--frames", "1:2"],
            1,
            "The page has no frame 0: --frames leaves it out",
        ),
        (["--video", "a.gif", "--frame", "0"], 1, "--frame applies only to --screenshot, --vector"),
        (["--html", "a.html", "--no-legend"], 1, "--no-legend applies only to --screenshot"),
        (["--screenshot", "a.png", "--frames", "1:2"], 1, "--frames applies only to --video"),
        (["--screenshot", "a.png", "--speed", "2"], 1, "--speed applies only to --video"),
        (["--screenshot", "a.png", "--speed", "0"], 2, "a speed is a number from 0.01 to 100"),
        (["--screenshot", "a.png", "--dpi", "300"], 1, "--dpi needs a size in millimetres"),
        (["--screenshot", "a.png", "--size-mm", "88"], 2, "is written 88x62, each side from 10"),
        (["--screenshot", "a.png", "--size-mm", "9x50"], 2, "is written 88x62, each side from 10"),
        (["--screenshot", "a.png", "--size-mm", "88x62", "--size", "9x9"], 2, "each side from 16"),
        (["--vector", "a.pdf", "--size-mm", "88x62", "--size", "90x90"], 2, "not allowed with"),
        (["--vector", "a.pdf", "--size-mm", "88x62", "--dpi", "300"], 1, "--dpi applies only to"),
        (["--screenshot", "a.png", "--size-mm", "900x90", "--dpi", "600"], 1, "each side may"),
        (["--screenshot", "a.png", "--size-mm", "20x20", "--frame", "1"], 1, "has no room for its"),
        (["--vector", "a.png"], 1, "a.png must end in .pdf or .svg"),
        (["--video", "a.avi"], 1, "a.avi must end in .mp4 or .gif"),
        (["--flow", "a.txt"], 1, "a.txt must end in .csv or .npz"),
        (["--flow", "a.csv", "--frame", "1", "--frames", "1:2"], 1, "leave one out"),
        (["--flow", "a.csv", "--frame", "1"], 1, "There is no flow: no frame lies n before"),
        (["--flow", "a.csv", "--dark"], 1, "--dark applies only to"),
        (["--plots", "a.jpg"], 1, "a.jpg must end in .pdf or .svg or .png or .csv"),
        (["--plots", "a.pdf", "--frame", "1"], 1, "--frame applies only to"),
        (["--clusters", "a.pdf"], 1, "a.pdf must end in .csv"),
        (["--clusters", "a.csv", "--frame", "1"], 1, "There are no clusters: no frame lies n"),
        (["--images", "room.mcap"], 1, "room.mcap is no folder"),
        (["--html", "a.html", "--view", "3d", "top"], 1, "An offline page has one view, got 2"),
        (["--screenshot", "no/a.png"], 1, "no/a.png cannot be written: there is no folder"),
        (["--screenshot", "a.txt"], 1, "a.txt must end in .png"),
        (["--html", "a.png"], 1, "a.png must end in .html"),
        (["--html", "."], 1, ". cannot be written: it is a folder"),
        (["--html", "a.html", "--gamma", "7"], 1, "gamma must be between 0 and 1, got 7"),
    ],
)
def test_wrong_arguments_are_one_sentence(room, monkeypatch, capsys, arguments, code, said):
    monkeypatch.chdir(room.parent)
    assert refusal(capsys, room, *arguments)[0] == code
    assert said in refusal(capsys, room, *arguments)[1]
    assert not list(room.parent.glob("a.*"))


def test_a_file_that_cannot_be_written_is_said_before_anything_is_computed(
    room, tmp_path, monkeypatch, capsys
):
    monkeypatch.setattr("app.exports.offline_page.offline_page", lambda *_: pytest.fail("computed"))
    place = tmp_path / "locked"
    place.mkdir()
    monkeypatch.setattr("app.output.checks.os.access", lambda path, _: path != place)
    code, said = refusal(capsys, room, "--html", place / "a.html")
    assert code == 1
    assert "cannot be written: permission denied" in said


@pytest.mark.parametrize("ending", ["csv", "pdf", "png", "svg"])
def test_plots_are_made_and_made_again_and_replace_nothing_else(room, tmp_path, capsys, ending):
    place = tmp_path / f"plots.{ending}"
    for _ in range(2):
        assert main(["export", str(room), "--plots", str(place), "--n", "1"]) == 0
        assert "3 frames of room" in capsys.readouterr().out
    place.write_text("mine")
    code, said = refusal(capsys, room, "--plots", place)
    assert code == 1
    assert "was not made by this command" in said


def test_the_clusters_of_a_frame_are_made_as_a_table(room, tmp_path, capsys):
    place = tmp_path / "clusters.csv"
    command = ["export", str(room), "--clusters", str(place), "--frame", "2", "--n", "1"]
    for _ in range(2):
        assert main(command) == 0
        assert "frame 2 of room" in capsys.readouterr().out
    assert place.read_text().startswith("# Tofscope clusters of frame 2; recording room.mcap; ")


def test_a_path_that_is_no_recording(tmp_path, capsys):
    assert "is a folder" in refusal(capsys, tmp_path, "--html", tmp_path / "a.html")[1]
    code, said = refusal(capsys, tmp_path / "no.mcap", "--html", tmp_path / "a.html")
    assert code == 1
    assert "There is no file or folder" in said


def test_without_chromium_it_says_how_to_get_one(room, tmp_path, monkeypatch, capsys):
    monkeypatch.setenv("PATH", str(tmp_path))
    monkeypatch.setenv("PLAYWRIGHT_BROWSERS_PATH", str(tmp_path))
    code, said = refusal(capsys, room, "--screenshot", tmp_path / "a.png")
    assert code == 1
    assert "there is none on the PATH" in said
    assert "apt-get install chromium" in said
    assert not (tmp_path / "a.png").exists()


def test_a_page_of_some_frames(tmp_path, capsys):
    sample = next(path for path in sample_paths() if "sideways" in path.name)
    place = tmp_path / "page.html"
    assert main(["export", str(sample), "--frames", "10:12", "--html", str(place)]) == 0
    page = place.read_text()
    assert f"<title>{sample.stem} (simulated)</title>" in page
    assert "10 to 12 of" in page
    assert "delta: 0.04" in page
    said = capsys.readouterr().out
    assert said.startswith(f"{place}: frames 10 to 12 of {sample.stem}")


def test_a_chromium_that_ends_at_once_is_one_sentence(room, tmp_path, monkeypatch, capsys):
    (tmp_path / "bin").mkdir()
    fake = tmp_path / "bin" / "chromium"
    fake.write_text("#!/bin/sh\nexit 7\n")
    fake.chmod(0o755)
    monkeypatch.setenv("PATH", f"{fake.parent}:{os.environ['PATH']}")
    code, said = refusal(capsys, room, "--screenshot", tmp_path / "a.png")
    assert code == 1
    assert f"Chromium at {fake} does not start (it ended at once, with the exit code 7)." in said


def test_a_figure_a_drawing_and_its_flow_are_made_without_chromium(tmp_path, monkeypatch, capsys):
    monkeypatch.setenv("PATH", str(tmp_path))
    sample = next(path for path in sample_paths() if "sideways" in path.name)
    flags = ["--size-mm", "88x62", "--view", "3d", "top", "--frame", "24"]
    for ending in ("pdf", "svg"):
        place = tmp_path / f"a.{ending}"
        assert main(["export", str(sample), *flags, "--vector", str(place)]) == 0
        said = capsys.readouterr().out
        assert said.startswith(f"{place}: frame 24 of {sample.stem}, ")
        assert place.stat().st_size < 2e6
    place = tmp_path / "a.npz"
    assert main(["export", str(sample), "--frames", "20:22", "--flow", str(place)]) == 0
    assert capsys.readouterr().out.startswith(f"{place}: frames 20 to 22 of {sample.stem}, ")
    with np.load(place) as arrays:
        assert set(arrays["frame"].tolist()) == {20, 21, 22}
    place = tmp_path / "a.csv"
    assert main(["export", str(sample), "--flow", str(place)]) == 0
    assert '"Data": "simulated' in place.read_text()


def test_a_video_without_ffmpeg_is_refused_before_anything_is_drawn(
    room, tmp_path, monkeypatch, capsys
):
    monkeypatch.setenv("PATH", str(tmp_path))
    monkeypatch.setitem(sys.modules, "imageio_ffmpeg", None)
    monkeypatch.setattr("app.exports.video.video", lambda *_: pytest.fail("drawn"))
    code, said = refusal(capsys, room, "--video", tmp_path / "a.mp4")
    assert code == 1
    assert "pip install imageio-ffmpeg" in said


def test_the_help_can_be_read_by_a_person(capsys):
    with pytest.raises(SystemExit):
        main(["export", "--help"])
    said = capsys.readouterr().out
    for flag in ("--size-mm", "--dpi", "--vector", "--video", "--images", "--flow", "--speed"):
        assert flag in said
    assert "a column of a paper" in said
