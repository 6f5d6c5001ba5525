"""Names from files and of files are printed and written so that nothing obeys them."""

import contextlib
import csv
import io
import logging
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest
from PIL import Image

from app.command_line import main
from app.commands.running import LogFormatter
from tests.conftest import REPOSITORY
from tests.recordings.room import write_room

# A terminal's title and its bell, a byte that is no text, the direction of writing.
NAME = b"=a\x1b]0;x\x07\r\xff\xe2\x80\xae\xe2\x81\xa6b.mcap"
OBEYED = re.compile(
    rb"[\x00-\x09\x0b-\x1f\x7f]|\xc2[\x80-\x9f]|\xe2\x80[\xaa-\xae]|\xe2\x81[\xa6-\xa9]"
)
LANGUAGES = (
    {},
    {"PYTHONIOENCODING": "ascii"},
    {"LC_ALL": "C", "PYTHONUTF8": "0", "PYTHONCOERCECLOCALE": "0"},
)


def ran(*arguments: str, code: int = 0) -> bytes:
    """What a command prints in this process; nothing of it is obeyed by a terminal."""
    out, said = (io.TextIOWrapper(io.BytesIO(), encoding="utf-8") for _ in range(2))
    with contextlib.redirect_stdout(out), contextlib.redirect_stderr(said):
        try:
            ended = main(list(arguments))
        except SystemExit as error:
            ended = error.code
    for stream in (out, said):
        stream.flush()
    return checked(ended, code, out.buffer.getvalue() + said.buffer.getvalue())  # type: ignore[attr-defined]


def ran_apart(folder: Path, *arguments: str, language: int) -> bytes:
    """What a command prints in a process of its own, in a pipe."""
    ended = subprocess.run(
        [sys.executable, "-m", "app", *arguments],
        cwd=folder,
        env=os.environ | {"PYTHONPATH": str(REPOSITORY)} | LANGUAGES[language],
        capture_output=True,
        check=False,
    )
    return checked(ended.returncode, 0, ended.stdout + ended.stderr)


def checked(ended: object, code: int, said: bytes) -> bytes:
    assert ended == code, said.decode(errors="replace")
    assert not OBEYED.search(said)
    assert b"Traceback" not in said
    return said


@pytest.fixture
def named(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> str:
    monkeypatch.chdir(tmp_path)
    room = write_room(tmp_path / "room.mcap", frames=12)
    os.rename(room.path, os.fsencode(tmp_path) + b"/" + NAME)
    return os.fsdecode(NAME)


@pytest.mark.parametrize("language", range(len(LANGUAGES)))
def test_whatever_the_name_of_a_recording_its_table_is_printed(
    language: int, named: str, tmp_path: Path
):
    said = ran_apart(tmp_path, "info", named, language=language)
    assert rb"=a\x1b]0;x\x07\r\udcff" in said


def test_whatever_the_name_of_a_recording_it_is_evaluated(named: str):
    ran("info", "--json", named)
    ran("evaluate", named, "--json", "a.json", "--fixed-frame", "\x1b[2J", code=1)
    ran("evaluate", named, "--json", "a.json")


def test_a_study_takes_any_name_and_gives_no_formula(named: str, tmp_path: Path):
    asked = ["--sweep", "--jobs", "1", "--method", "baseline"]
    ran("study", "--recordings", named, "--out", "out", *asked)
    known = ran("study", "--recordings", named, "--out", "out", *asked)
    assert b"1 of 1 recordings are known from before." in known
    with (tmp_path / "out" / "tables" / "recordings.csv").open(
        encoding="utf-8", newline=""
    ) as file:
        names = [row["recording"] for row in csv.DictReader(file)]
    assert names
    assert all(name.startswith("'=a") for name in names)


def test_pages_and_pictures_take_any_name(named: str, tmp_path: Path):
    ran("export", named, "--html", "a\u202e.html", "--frames", "9:10")
    page = (tmp_path / "a\u202e.html").read_text("utf-8")
    assert r"\udcff" in page
    if shutil.which("chromium"):
        ran("export", named, "--screenshot", "a.png", "--size", "64x64", "--frame", "9")
        with Image.open(tmp_path / "a.png") as picture:
            assert r"\udcff" in picture.info["Recording"]


@pytest.mark.parametrize(
    "name", ["topic_escape", "prov_html", "topic_same", "tf_object_5000_digits"]
)
def test_names_in_a_file_are_escapes(name: str, shared_data: Path):
    path = str(shared_data / "hostile" / f"{name}.mcap")
    for command in (["info", path], ["info", "--json", path]):
        ran(*command, "--log-level", "debug")


def test_a_line_of_the_log_is_escaped():
    record = logging.LogRecord("app", logging.ERROR, "", 1, "topic %s", ("\x1b[31m\u202e\r",), None)
    assert LogFormatter("%(message)s").format(record) == r"topic \x1b[31m\u202e\r"


def test_sentences_of_errors_are_escaped(named: str, tmp_path: Path):
    (tmp_path / "own\x1b[2J.py").write_text("raise ValueError('\\x07')")
    asked = ["--method", "own\x1b[2J.py:flow"]
    said = ran("evaluate", named, *asked, code=2)
    assert rb"ValueError: \x07" in said
    ran("info", "none\x1b\u2066.mcap", code=1)
    ran("info", named, "--\x1b[2J", code=2)
    ran("evaluate", named, "--json", "\x1b[2J.txt", code=1)
