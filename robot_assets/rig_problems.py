"""What is wrong with a rig file, for the person who wrote it."""

import reprlib
from typing import Any, get_args

from pydantic import BaseModel, ValidationError
from pydantic_core import ErrorDetails

from robot_assets.rig_file import EXPECTED, WHOLE, RigFile

_MOST = 3
"""Problems that are said; who mends them sees the others next."""
_LONGEST = 60
"""Characters of a key; what is longer is cut."""


def problems(error: ValidationError) -> str:
    """Sentence that names each key with a problem, what was found and what is expected."""
    found: list[ErrorDetails] = []
    with_unknown_keys: set[tuple[int | str, ...]] = set()
    for each in error.errors(include_url=False):
        table = each["loc"][:-1]
        if each["type"] != "extra_forbidden":
            found.append(each)
        elif table not in with_unknown_keys:  # one of a table, with all the known ones, will do
            with_unknown_keys.add(table)
            found.append(each)
    said = "; ".join(map(_said, found[:_MOST]))
    return f"{said}; and {len(found) - _MOST} more." if len(found) > _MOST else f"{said}."


def _said(error: ErrorDetails) -> str:
    where, kind = error["loc"], error["type"]
    if kind == WHOLE:
        return error["msg"]
    name = _name(where)
    if kind == "missing":
        return f"{name} is missing"
    if kind == "extra_forbidden":
        return f"{name} is not a known key; known are {', '.join(_keys(where[:-1]))}"
    got = f"got {_shown(error['input'])}"
    if kind == EXPECTED:
        return f"{name} {error['msg']}, {got}"
    if _is_array(where[0]):
        return f"{where[0]} must be tables, each headed [[{where[0]}]], {got}"
    return f"{name} must be a table, {got}"


def _shown(value: object) -> str:
    try:
        return reprlib.repr(value)
    except ValueError:  # Python writes no number that is as long as a hexadecimal one may be
        return "a number of thousands of digits"


def _name(where: tuple[int | str, ...]) -> str:
    """Path of a key in its file, such as rings[0].radius_m."""
    name = ""
    for part in where:
        if isinstance(part, int):
            name += f"[{part}]"
        else:
            # Whoever made the file may have put anything into a key.
            plain = part if part.isprintable() and len(part) <= _LONGEST else reprlib.repr(part)
            name += f".{plain}" if name else plain
    return name


def _keys(where: tuple[int | str, ...]) -> list[str]:
    """The keys that a table of a rig file may have."""
    table: type[BaseModel] = RigFile
    if where:
        annotation: Any = RigFile.model_fields[str(where[0])].annotation
        table = (*get_args(annotation), annotation)[0]
    return list(table.model_fields)


def _is_array(key: int | str) -> bool:
    return bool(get_args(RigFile.model_fields[str(key)].annotation))
