"""Strict JSON from files, links and browsers; errors are one sentence."""

import json
import reprlib
from typing import Any

from app.errors import InputError

LARGEST = 10_000_000
"""Bytes or characters; a table of `tofscope evaluate` has less than one thousand a recording."""
_DIGITS = 100
_KINDS = {dict: "a table", list: "a list", str: "a text", bool: "true or false"}


def from_json(text: str, where: str) -> Any:  # noqa: ANN401 (whatever JSON holds)
    """Parse JSON without duplicate keys and without NaN or Infinity.

    Args:
        text: JSON.
        where: a file's name, for error messages.

    Raises:
        InputError: the text is too long, not JSON or nested too deeply, or has a key twice, NaN,
            Infinity, or a whole number of more than 100 digits.
    """
    check_size(len(text), where)

    def once_each(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
        content: dict[str, Any] = {}
        for key, value in pairs:
            if key in content:
                raise InputError(f"{where} has the key {reprlib.repr(key)} twice; leave one out.")
            content[key] = value
        return content

    def no_constant(name: str) -> None:
        raise InputError(f"{where} holds {name}, which is not a JSON number; give a number.")

    def whole(digits: str) -> int:
        if len(digits) > _DIGITS:
            raise InputError(f"{where} holds a number of {len(digits)} digits; give a smaller one.")
        return int(digits)

    try:
        return json.loads(
            text, object_pairs_hook=once_each, parse_constant=no_constant, parse_int=whole
        )
    except RecursionError as error:
        raise InputError(f"{where} has too deeply nested lists or tables.") from error
    except ValueError as error:
        raise InputError(f"{where} is not JSON: {error}.") from error


def check_size(size: int, where: str) -> None:
    """Raise InputError where a text is too large to be read."""
    if size > LARGEST:
        raise InputError(
            f"{where} has more than {LARGEST // 1_000_000} MB, too much to be read as JSON; check "
            "the name."
        )


def kind_of(value: object) -> str:
    """A value's kind in a sentence, such as "a list"."""
    return "null" if value is None else _KINDS.get(type(value), "a number")
