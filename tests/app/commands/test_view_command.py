import re
import signal
import socket
import subprocess
import sys
import time
import urllib.request
from pathlib import Path

import pytest

from app.command_line import main
from app.commands import view

TOFSCOPE = str(Path(sys.executable).parent / "tofscope")


def refusal(capsys, *arguments):
    """Run `tofscope view`, which must refuse; its exit code and its one line on standard error."""
    try:
        code = main(["view", *map(str, arguments)])
    except SystemExit as error:
        code = error.code
    captured = capsys.readouterr()
    assert captured.out == ""
    assert captured.err.count("\n") == 1
    return code, captured.err


def test_a_path_that_is_not_there(capsys, tmp_path):
    code, said = refusal(capsys, tmp_path / "nothing.mcap")
    assert code == 1
    assert "There is no file or folder" in said
    assert "nothing.mcap" in said


def test_the_only_recording_must_open(capsys, tmp_path):
    (tmp_path / "bad.mcap").write_bytes(b"not a recording")
    code, said = refusal(capsys, tmp_path / "bad.mcap")
    assert code == 1
    assert "bad.mcap" in said


def test_a_parameter_out_of_range(capsys):
    code, said = refusal(capsys, "--gamma", "7")
    assert code == 1
    assert "gamma must be between 0 and 1, got 7" in said


@pytest.mark.parametrize("port", ["70000", "http", "-1"])
def test_a_port_that_is_none(capsys, port):
    code, said = refusal(capsys, f"--port={port}")
    assert code == 2
    assert "a port is a number from 0 to 65535" in said


@pytest.mark.parametrize(
    "origin",
    [
        "",
        "lab.example",
        "ftp://lab.example",
        "https://",
        "https://*.example",
        "https://lab.example/page",
        "https://lab.example?x",
        "https://a.example https://b.example",
        "https://a.example;script-src *",
        "https://a.example\r\nSet-Cookie: x",
        "https://me@lab.example",
        "http://lab.example:port",
        "http://[::1",
        "'self'",
        "*",
        "null",
    ],
)
def test_an_origin_that_is_none(capsys, origin):
    code, said = refusal(capsys, f"--embed-in={origin}")
    assert code == 2
    assert "an origin is http:// or https:// and a host" in said


@pytest.mark.parametrize(
    ("given", "sent"),
    [
        ("https://lab.example", "https://lab.example"),
        ("http://localhost:8888/", "http://localhost:8888"),
        ("HTTP://Lab.Example:81", "http://lab.example:81"),
        ("http://[::1]:8888", "http://[::1]:8888"),
        ("http://192.0.2.7", "http://192.0.2.7"),
    ],
)
def test_an_origin_is_as_browsers_write_it(given, sent):
    assert view._origin(given) == sent


def test_a_port_in_use(capsys, tmp_path):
    with socket.create_server(("127.0.0.1", 0)) as taken:
        port = taken.getsockname()[1]
        code, said = refusal(capsys, tmp_path, "--port", port)
    assert code == 1
    assert f"127.0.0.1, port {port}" in said
    assert "choose another" in said


def test_an_address_that_is_not_this_machines(capsys, tmp_path):
    code, said = refusal(capsys, tmp_path, "--host", "203.0.113.7", "--port", "0")
    assert code == 1
    assert "203.0.113.7" in said


def test_help_is_for_people(capsys):
    with pytest.raises(SystemExit) as ended:
        main(["view", "--help"])
    assert ended.value.code == 0
    said = capsys.readouterr().out
    for word in (
        "--host",
        "--port",
        "--embed-in",
        "--fixed-frame",
        "--truth-frame",
        "--n-min",
        "samples",
    ):
        assert word in said


def test_it_says_where_it_is_and_ends_quietly(tmp_path):
    app = subprocess.Popen(
        [TOFSCOPE, "view", str(tmp_path), "--port", "0"],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    )
    assert app.stdout is not None
    line = app.stdout.readline()
    assert line.startswith("Tofscope is at http://127.0.0.1:")
    address = line.split()[-1]
    with urllib.request.urlopen(address, timeout=10) as page:
        assert page.status == 200
    app.send_signal(signal.SIGINT)
    out, err = app.communicate(timeout=10)
    assert app.returncode == 0
    assert (out, err) == ("", "")


_ENDED_BY_A_THREAD = """
import signal, sys, threading
import app.analysis.estimates
from app.command_line import main

def end():
    sys.stdin.readline()
    signal.pthread_kill(threading.get_ident(), signal.SIGTERM)

app.analysis.estimates.warm_up = lambda: None
threading.Thread(target=end, daemon=True).start()
sys.exit(main(["view", sys.argv[1], "--port", "0"]))
"""


def test_a_signal_that_reaches_another_thread_ends_it_too(tmp_path):
    app = subprocess.Popen(
        [sys.executable, "-c", _ENDED_BY_A_THREAD, str(tmp_path)],
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        text=True,
    )
    assert app.stdin is not None
    assert app.stdout is not None
    assert app.stdout.readline().startswith("Tofscope is at")
    time.sleep(2.0)  # by now it does nothing but wait
    try:
        app.communicate("now\n", timeout=10)
    finally:
        app.kill()
    assert app.returncode == 0


def test_serving_to_everybody_is_warned_of_and_ends_when_it_is_terminated(tmp_path):
    app = subprocess.Popen(
        [TOFSCOPE, "view", str(tmp_path), "--host", "0.0.0.0", "--port", "0"],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    )
    assert app.stdout is not None
    assert app.stdout.readline().startswith("Tofscope is at http://127.0.0.1:")
    app.send_signal(signal.SIGTERM)
    _, err = app.communicate(timeout=10)
    assert app.returncode == 0
    assert err.startswith("Warning: at 0.0.0.0 everybody")
    assert "change and delete the presets" in err
    assert "nothing is encrypted" in err
    (others,) = re.findall(r"Others find the page at http://(\S+):\d+\.", err)
    assert others not in {"0.0.0.0", ""}
    assert err.count("\n") == 1
