"""Messages about the errors in a rig file."""

import reprlib
from typing import Any, get_args

from pydantic import BaseModel, ValidationError
from pydantic_core import ErrorDetails

from robot_assets.rig_file import WRONG_RIG, WRONG_VALUE, RigFile

_MAX_PROBLEMS = 3
"""Problems listed in one message; further ones show once these are fixed."""
_MAX_KEY = 60
"""Characters of a key; longer ones are cut."""


def problems(error: ValidationError) -> str:
    """Message with each wrong key, the expected value and the one found."""
    found: list[ErrorDetails] = []
    with_unknown_keys: set[tuple[int | str, ...]] = set()
    for each in error.errors(include_url=False):
        table = each["loc"][:-1]
        if each["type"] != "extra_forbidden":
            found.append(each)
        elif table not in with_unknown_keys:  # one per table: its message lists all known keys
            with_unknown_keys.add(table)
            found.append(each)
    listed = "; ".join(map(_problem, found[:_MAX_PROBLEMS]))
    more = len(found) - _MAX_PROBLEMS
    return f"{listed}; and {more} more." if more > 0 else f"{listed}."


def _problem(error: ErrorDetails) -> str:
    where, kind = error["loc"], error["type"]
    if kind == WRONG_RIG:
        return error["msg"]
    name = _name(where)
    if kind == "missing":
        return f"{name} is missing"
    if kind == "extra_forbidden":
        return f"{name} is not a known key; known are {', '.join(_keys(where[:-1]))}"
    got = f"got {_shown(error['input'])}"
    if kind == WRONG_VALUE:
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
            plain = part if part.isprintable() and len(part) <= _MAX_KEY else reprlib.repr(part)
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
