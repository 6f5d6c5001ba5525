"""Checks of output files before anything is computed for them."""

import json
import os
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from pathlib import Path

from app.errors import InputError

GENERATOR = '<meta name="generator" content="Tofscope">'
"""Element of a page's head by which it is known as Tofscope's."""

_LARGEST = 200_000_000
"""Bytes of a file that is read to find out who made it."""

_HEAD = 4096
"""Bytes of a page within which its head names its generator."""


@dataclass(frozen=True)
class OutputKind:
    """Kind of file that a command writes.

    Attributes:
        ending: of its name, with the dot.
        is_ours: whether an existing file is one that the command wrote.
    """

    ending: str
    is_ours: Callable[[Path], bool]


def check_output(path: Path, kind: OutputKind, inputs: Iterable[Path] = ()) -> None:
    """Check that a file can be written without the loss of another.

    Args:
        path: of the file.
        kind: of the file.
        inputs: files that are read, which must not be replaced.

    Raises:
        InputError: the name has another ending, the file is an input or was not made by Tofscope,
            or it cannot be written.
    """
    check_writable(path)
    if not path.exists():
        if path.is_symlink():
            raise InputError(f"{path} is a link to nothing; remove it or give another name.")
        _check_ending(path, kind.ending)
    elif path.is_file():
        if any(read.exists() and os.path.samefile(read, path) for read in inputs):
            raise InputError(f"{path} is an input, and would be overwritten; give another name.")
        _check_ending(path, kind.ending)
        if path.stat().st_size and not is_ours(path, kind):
            raise InputError(
                f"{path} exists and was not made by this command; remove it or give another name."
            )


def check_output_of(
    path: Path, kinds: Mapping[str, OutputKind], inputs: Iterable[Path] = ()
) -> None:
    """`check_output` for the kind that a file's ending names, {ending: kind}.

    Raises:
        InputError: it names none of them, or as by `check_output`.
    """
    kind = kinds.get(path.suffix.lower())
    if kind is None:
        raise InputError(f"{path} must end in {' or '.join(kinds)}, so that its format is known.")
    check_output(path, kind, inputs)


def check_writable(path: Path) -> None:
    """Check that a file can be written, or replaced.

    Raises:
        InputError: it is a folder, its folder does not exist, or permission is denied.
    """
    folder = path.absolute().parent
    if path.is_dir():
        raise InputError(f"{path} cannot be written: it is a folder.")
    if not folder.is_dir():
        raise InputError(f"{path} cannot be written: there is no folder {folder}.")
    if path.exists() and not path.is_file():
        return  # a device or a pipe
    folder = path.resolve().parent  # of what a link names
    if not os.access(folder, os.W_OK) or (path.exists() and not os.access(path, os.W_OK)):
        raise InputError(f"{path} cannot be written: permission denied.")


def is_ours(path: Path, kind: OutputKind) -> bool:
    """Whether a file is one that Tofscope wrote; False where it cannot be read."""
    try:
        return path.stat().st_size <= _LARGEST and kind.is_ours(path)
    except (OSError, ValueError, RecursionError):
        return False


def _check_ending(path: Path, ending: str) -> None:
    if path.suffix.lower() != ending:
        raise InputError(f"{path} must end in {ending}, so that programs know its format.")


def _is_table(path: Path) -> bool:
    content = json.loads(path.read_bytes())
    if not isinstance(content, dict) or not {"parameters", "recordings", "means"} <= content.keys():
        return False
    rows = content["recordings"]
    return (
        isinstance(content["parameters"], dict)
        and isinstance(rows, list)
        and all(isinstance(row, dict) and {"path", "pairs"} <= row.keys() for row in rows)
    )


def _is_parameters(path: Path) -> bool:
    return isinstance(json.loads(path.read_bytes()), dict)


def _is_picture(path: Path) -> bool:
    from PIL import Image, UnidentifiedImageError

    try:
        with Image.open(path) as picture:
            return picture.info.get("Software") == "Tofscope"
    except (UnidentifiedImageError, Image.DecompressionBombError):
        return False


def _is_page(path: Path) -> bool:
    with path.open("rb") as page:
        return GENERATOR.encode() in page.read(_HEAD)


TABLE = OutputKind(".json", _is_table)
"""`tofscope evaluate --json`."""

PARAMETERS = OutputKind(".json", _is_parameters)
"""A preset."""

PICTURE = OutputKind(".png", _is_picture)
"""`tofscope export --screenshot`."""

PAGE = OutputKind(".html", _is_page)
"""`tofscope export --html`, and the page of a study."""
