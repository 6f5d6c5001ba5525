"""Folders of numbered pictures, written whole and put in their place at the end."""

import os
import re
import shutil
from collections.abc import Iterable
from pathlib import Path
from uuid import uuid4

from app.errors import InputError
from app.output.checks import PICTURE, is_ours
from app.output.writing import DRAFT

_NAMES = re.compile(r"frame_\d{6}\.png")


def image_name(number: int) -> str:
    """Name of the picture of a frame, by which names are in its order."""
    return f"frame_{number:06d}.png"


def check_image_folder(path: Path) -> None:
    """Check that a folder of pictures can be made without the loss of anything else.

    Raises:
        InputError: there is a file of this name, or a folder that holds something else than
            pictures that Tofscope numbered, or permission is denied.
    """
    parent = path.resolve().parent
    if path.is_symlink() and not path.exists():
        raise InputError(f"{path} is a link to nothing; remove it or give another name.")
    if path.exists() and not path.is_dir():
        raise InputError(f"{path} is no folder; give another name for one.")
    if not parent.is_dir():
        raise InputError(f"{path} cannot be made: there is no folder {parent}.")
    if not os.access(parent, os.W_OK) or (path.exists() and not os.access(path, os.W_OK)):
        raise InputError(f"{path} cannot be written: permission denied.")
    if path.is_dir() and not all(map(_is_numbered_picture, path.iterdir())):
        raise InputError(
            f"{path} holds files that were not made by this command; remove them or give another "
            "name."
        )


def write_image_folder(path: Path, pictures: Iterable[tuple[int, bytes]]) -> int:
    """Write pictures into a folder, in place of those that are there.

    Args:
        path: of the folder, which `check_image_folder` accepted.
        pictures: number and content of each.

    Returns:
        How many there are.

    Raises:
        InputError: they cannot be written.
    """
    place = path.resolve()
    draft = place.with_name(DRAFT.format(uuid4().hex))
    count = 0
    try:
        draft.mkdir()
        for number, content in pictures:
            (draft / image_name(number)).write_bytes(content)
            count += 1
        if place.exists():
            # Once more, since it took a while.
            check_image_folder(path)
            shutil.rmtree(place)
        draft.rename(place)
    except OSError as error:
        raise InputError(f"{path} cannot be written: {error.strerror}.") from error
    finally:
        shutil.rmtree(draft, ignore_errors=True)
    return count


def _is_numbered_picture(path: Path) -> bool:
    return _NAMES.fullmatch(path.name) is not None and path.is_file() and is_ours(path, PICTURE)
