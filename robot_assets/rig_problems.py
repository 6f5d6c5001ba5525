"""Messages about the errors in a rig file."""

import reprlib
from typing import Any, get_args

from pydantic import BaseModel, ValidationError
from pydantic_core import ErrorDetails

from robot_assets.rig_file import EXPECTED, WHOLE, RigFile

_MOST = 3
"""Problems in one message; further ones show once these are fixed."""
_LONGEST = 60
"""Characters of a key, longer ones are cut."""


def problems(error: ValidationError) -> str:
    """Message with each wrong key, the expected value and the one found."""
    found: list[ErrorDetails] = []
    with_unknown_keys: set[tuple[int | str, ...]] = set()
    for each in error.errors(include_url=False):
        table = each["loc"][:-1]
        if each["type"] != "extra_forbidden":
            found.append(each)
        elif table not in with_unknown_keys:  # one per table, its message lists all known keys
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
    except ValueError:  # Python refuses to print very long integers, which TOML may hold in hex
        return "a number of thousands of digits"


def _name(where: tuple[int | str, ...]) -> str:
    """Path of a key in its file, such as rings[0].radius_m."""
    name = ""
    for part in where:
        if isinstance(part, int):
            name += f"[{part}]"
        else:
            # A key may hold any characters.
            plain = part if part.isprintable() and len(part) <= _LONGEST else reprlib.repr(part)
            name += f".{plain}" if name else plain
    return name


def _keys(where: tuple[int | str, ...]) -> list[str]:
    """Known keys of a table of a rig file."""
    table: type[BaseModel] = RigFile
    if where:
        annotation: Any = RigFile.model_fields[str(where[0])].annotation
        table = (*get_args(annotation), annotation)[0]
    return list(table.model_fields)


def _is_array(key: int | str) -> bool:
    return bool(get_args(RigFile.model_fields[str(key)].annotation))
