"""MP4 files, written by the program ffmpeg."""

import os
import shutil
import signal
import subprocess
from collections.abc import Iterable, Mapping
from contextlib import suppress
from pathlib import Path
from typing import BinaryIO

from PIL import Image

from app.errors import InputError
from app.output.scratch import scratch_folder

_QUALITY = 17
"""Constant rate factor of H.264: below 18, nobody sees a difference."""


def mp4(
    pictures: Iterable[tuple[Image.Image, int]],
    rate: int,
    about: Mapping[str, str],
) -> bytes:
    """Encode pictures as H.264, which players, browsers and slides show.

    Args:
        pictures: of one size, each with the number of times that it is shown.
        rate: pictures per second.
        about: {key of MP4: value}, such as title and comment.

    Raises:
        InputError: ffmpeg is missing or fails.
    """
    program = find_ffmpeg()
    with scratch_folder() as folder:
        place, said = folder / "video.mp4", folder / "said.txt"
        process: subprocess.Popen[bytes] | None = None
        with said.open("wb") as errors:
            try:
                for picture, times in pictures:
                    if process is None:
                        process = _started(program, picture.size, rate, about, place, errors)
                    _feed(process, picture.convert("RGB").tobytes(), times)
                code = _ended(process)
            finally:
                if process is not None:
                    with suppress(ProcessLookupError):
                        os.killpg(process.pid, signal.SIGKILL)
                    process.wait()
        if code != 0 or not place.exists():
            lines = said.read_text("utf-8", "replace").strip().splitlines() or ["no reason given"]
            raise InputError(f"ffmpeg at {program} made no MP4 file ({lines[-1].strip()}).")
        return place.read_bytes()


def find_ffmpeg() -> str:
    """Path of ffmpeg: the system's, else the one of the package imageio-ffmpeg.

    Raises:
        InputError: there is none.
    """
    if path := shutil.which("ffmpeg"):
        return path
    try:
        import imageio_ffmpeg

        return imageio_ffmpeg.get_ffmpeg_exe()
    except (ImportError, RuntimeError) as error:
        raise InputError(
            "MP4 files are written by ffmpeg, and there is none on the PATH; install it with "
            "'sudo apt-get install ffmpeg' or with 'pip install imageio-ffmpeg', or name a .gif."
        ) from error


def _started(
    program: str,
    size: tuple[int, int],
    rate: int,
    about: Mapping[str, str],
    place: Path,
    errors: BinaryIO,
) -> subprocess.Popen[bytes]:
    width, height = size
    command = [program, "-hide_banner", "-loglevel", "error", "-y"]
    command += ["-f", "rawvideo", "-pix_fmt", "rgb24", "-s", f"{width}x{height}"]
    command += ["-r", str(rate), "-i", "-", "-an"]
    # Players want chroma of half the size, and so even sides.
    command += ["-vf", "pad=ceil(iw/2)*2:ceil(ih/2)*2:color=white"]
    command += ["-c:v", "libx264", "-crf", str(_QUALITY), "-pix_fmt", "yuv420p"]
    command += ["-movflags", "+faststart"]
    for key, value in about.items():
        command += ["-metadata", f"{key}={value}"]
    return subprocess.Popen(
        [*command, str(place)],
        stdin=subprocess.PIPE,
        stdout=subprocess.DEVNULL,
        stderr=errors,
        # Ctrl-C in a terminal reaches only us, and we end it.
        start_new_session=True,
    )


def _feed(process: subprocess.Popen[bytes], picture: bytes, times: int) -> None:
    assert process.stdin is not None
    # Where it has ended, its exit code and its words say why.
    with suppress(BrokenPipeError):
        for _ in range(times):
            process.stdin.write(picture)


def _ended(process: subprocess.Popen[bytes] | None) -> int:
    if process is None or process.stdin is None:
        return -1
    with suppress(BrokenPipeError):
        process.stdin.close()
    return process.wait()
