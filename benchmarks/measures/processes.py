"""What is measured in a process of its own: start, memory, and what a played recording sends."""

import subprocess
import sys
import tempfile
from collections.abc import Iterator
from functools import partial
from pathlib import Path

from benchmarks import naive
from benchmarks.inputs import WHOLE, write_whole
from benchmarks.playback import playing
from benchmarks.rows import Row, against_naive

_STARTS = 7
_PLAYED = 6.0  # seconds


def measure() -> Iterator[Row]:
    """Help, memory after all pairs of a recording, and bytes a frame."""
    command = [sys.executable, "-m", "app", "--help"]
    run = partial(subprocess.run, command, check=True, stdout=subprocess.DEVNULL)
    yield against_naive(
        "tofscope --help (naive: a pair alone)", [run] * _STARTS, naive.pairs_alone(_STARTS), 1
    )
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "whole.mcap"
        write_whole(path)
        estimating = [sys.executable, "-m", "benchmarks.measures.resident", str(path)]
        said = subprocess.run(estimating, check=True, stdout=subprocess.PIPE, text=True).stdout
    yield Row(f"memory after {WHOLE} pairs were estimated", float(said), "MB")
    with playing() as play:
        played = play(1.0, _PLAYED)
    if played is None:
        raise RuntimeError("Nothing came while the first sample was played.")
    yield Row("a frame on the wire, the first sample played", played.bytes_a_frame / 1e3, "kB")
