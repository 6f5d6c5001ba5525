"""Files that commands read: what is no regular file, too large or nonsense is one sentence."""

import os
import socket
import subprocess
import sys
import threading
from collections.abc import Iterator
from pathlib import Path

import pytest

from app.command_line import main
from recordings import sample_paths
from tests.conftest import REPOSITORY

SAMPLE = str(sample_paths()[0])
DEEP = 100_000


@pytest.fixture
def fifo(tmp_path: Path) -> Iterator[Path]:
    """A pipe that nobody writes to: a command that opened it would wait for ever."""
    path = tmp_path / "fifo"
    os.mkfifo(path)

    def release() -> None:
        os.close(os.open(path, os.O_RDWR | os.O_NONBLOCK))

    end = threading.Timer(20, release)
    end.start()
    yield path
    end.cancel()


def commands(file: Path, tmp_path: Path) -> dict[str, list[str]]:
    """A command for every way to read a file."""
    page = ["--html", str(tmp_path / "a.html")]
    out = ["--out", str(tmp_path / "out"), "--jobs", "1"]
    return {
        "info": ["info", str(file)],
        "evaluate": ["evaluate", str(file)],
        "export": ["export", str(file), *page],
        "view": ["view", str(file), "--port", "0"],
        "recordings": ["study", "--recordings", str(file), *out],
        "parameters": ["evaluate", SAMPLE, "--parameters", str(file)],
        "rig": ["simulate", "towards", "--rig", str(file), "--out", str(tmp_path / "b.mcap")],
        "study rig": ["study", "--rig", str(file), *out],
        "urdf": ["info", SAMPLE, "--urdf", str(file)],
    }


WAYS = [*commands(Path(), Path())]


def the_sentence(command: list[str], capsys: pytest.CaptureFixture[str]) -> str:
    """What a command that fails says; it is one line."""
    assert main(command) == 1
    said = capsys.readouterr().err
    assert said.count("\n") == 1
    assert "Traceback" not in said
    return said


@pytest.mark.parametrize("way", WAYS)
def test_a_pipe_is_not_waited_for(
    way: str, fifo: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
):
    said = the_sentence(commands(fifo, tmp_path)[way], capsys)
    assert "it is a pipe, which cannot be read from any place; save its content to a file" in said


@pytest.mark.parametrize("way", WAYS)
def test_a_device_is_not_read_for_ever(
    way: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
):
    said = the_sentence(commands(Path("/dev/zero"), tmp_path)[way], capsys)
    assert "it is a device and not a regular file" in said


@pytest.mark.parametrize("way", ["info", "parameters", "rig", "urdf"])
def test_a_folder_and_a_socket_are_not_files(
    way: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
):
    folder, place = tmp_path / "folder", tmp_path / "socket"
    folder.mkdir()
    assert "is a folder" in the_sentence(commands(folder, tmp_path)[way], capsys)
    with socket.socket(socket.AF_UNIX) as listening:
        listening.bind(str(place))
        assert "it is a socket" in the_sentence(commands(place, tmp_path)[way], capsys)


def test_standard_input_is_read_where_it_is_a_file_and_not_where_it_is_a_pipe():
    command = [sys.executable, "-m", "app", "info", "/dev/stdin"]
    content = Path(SAMPLE).read_bytes()
    piped = subprocess.run(command, cwd=REPOSITORY, input=content, capture_output=True, check=False)
    assert piped.returncode == 1
    assert b"/dev/stdin cannot be read: it is a pipe, which cannot be read from any" in piped.stderr
    with Path(SAMPLE).open("rb") as file:
        read = subprocess.run(command, cwd=REPOSITORY, stdin=file, capture_output=True, check=False)
    assert read.returncode == 0


@pytest.mark.parametrize(
    ("content", "said"),
    [
        (DEEP * b"[", "has too deeply nested lists or tables."),
        (DEEP * b'{"n":', "has too deeply nested lists or tables."),
        (b'{"n": ' + 5000 * b"1" + b"}", "holds a number of 5000 digits; give a smaller one."),
        (b'{"gamma": NaN}', "holds NaN, which is not a JSON number; give a number."),
        (b'{"gamma": -Infinity}', "holds -Infinity, which is not a JSON number; give a number."),
        (b'{"gamma": 1e999}', "gamma must be between 0 and 1, got inf"),
        (b'{"n": "\xff"}', "is not a text file, so it cannot be a parameter file."),
        (b'{"n"\0: 3}', "is not JSON"),
        (b'{"n": 3}' + 10_000_000 * b" ", "has more than 10 MB, too much to be read as JSON"),
    ],
    ids=["lists", "tables", "digits", "nan", "infinity", "1e999", "utf-8", "nul", "size"],
)
def test_parameters_that_are_nonsense_are_one_sentence(
    content: bytes, said: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
):
    file = tmp_path / "parameters.json"
    file.write_bytes(content)
    assert said in the_sentence(commands(file, tmp_path)["parameters"], capsys)


@pytest.mark.parametrize(
    ("content", "said"),
    [
        (b"a = " + DEEP * b"[", "has too deeply nested lists or tables."),
        (b"a = " + DEEP * b"{a = ", "has too deeply nested lists or tables."),
        (b"a = " + 5000 * b"1", "holds a number of thousands of digits; give a smaller one."),
        (b"a = 0x" + 5000 * b"f", "a is not a known key"),
        (b"name = nan", "name must be a text, got nan"),
        (b'name = "\xff"', "is not a text file, so it cannot be a rig file."),
        (b'name = "\0"', "is not a TOML file"),
        (1_000_001 * b"#", "has more than 1000000 bytes, too many for a rig file"),
    ],
    ids=["lists", "tables", "digits", "hexadecimal", "nan", "utf-8", "nul", "size"],
)
def test_a_rig_that_is_nonsense_is_one_sentence(
    content: bytes, said: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
):
    file = tmp_path / "rig.toml"
    file.write_bytes(content)
    assert said in the_sentence(commands(file, tmp_path)["rig"], capsys)


def test_a_file_of_a_gigabyte_is_not_read(tmp_path: Path, capsys: pytest.CaptureFixture[str]):
    file = tmp_path / "large"
    with file.open("wb") as stream:
        stream.truncate(2**30)
    for way, said in (
        ("parameters", "has more than 10 MB, too much to be read as JSON"),
        ("rig", "has more than 1000000 bytes"),
        ("urdf", "has more than 16777216 bytes, too many for a URDF"),
        ("info", "is not an MCAP file"),
    ):
        assert said in the_sentence(commands(file, tmp_path)[way], capsys)


def test_a_byte_order_mark_is_no_part_of_a_text(tmp_path: Path):
    rig, parameters = tmp_path / "rig.toml", tmp_path / "parameters.json"
    own = (REPOSITORY / "robot_assets" / "rigs" / "paper.toml").read_bytes()
    rig.write_bytes(b"\xef\xbb\xbf" + own)
    parameters.write_bytes(b'\xef\xbb\xbf{"n": 30}')
    given = ["--rig", str(rig), "--parameters", str(parameters)]
    assert main(["export", SAMPLE, *given, "--html", str(tmp_path / "a.html")]) == 0


def test_a_method_file_that_ends_the_program_is_one_sentence(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
):
    file = tmp_path / "own.py"
    file.write_text("raise SystemExit(0)")
    with pytest.raises(SystemExit) as ended:
        main(["evaluate", SAMPLE, "--method", f"{file}:flow"])
    assert ended.value.code == 2
    assert "own.py cannot be run: SystemExit: 0" in capsys.readouterr().err
