"""JSON from files, links and browsers, with one sentence for what is wrong with it."""

import json
import reprlib
from typing import Any

from app.errors import InputError

LARGEST = 10_000_000
"""Bytes or characters; a table of `tofscope evaluate` has less than one thousand a recording."""
_DIGITS = 100
_KINDS = {dict: "a table", list: "a list", str: "a text", bool: "true or false"}


def from_json(text: str, where: str) -> Any:  # noqa: ANN401 (whatever JSON holds)
    """Content of a text in which every key stands once and every number is one.

    Args:
        text: JSON.
        where: a file's name, for the sentence.

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
        raise InputError(f"{where} holds {name}, which is no number of JSON; give a number.")

    def whole(digits: str) -> int:
        if len(digits) > _DIGITS:
            raise InputError(f"{where} holds a number of {len(digits)} digits; give a smaller one.")
        return int(digits)

    try:
        return json.loads(
            text, object_pairs_hook=once_each, parse_constant=no_constant, parse_int=whole
        )
    except RecursionError as error:
        raise InputError(f"{where} has lists or tables in each other, too many to read.") from error
    except ValueError as error:
        raise InputError(f"{where} is not JSON: {error}.") from error


def check_size(size: int, where: str) -> None:
    """Raise InputError for what is too large to be read."""
    if size > LARGEST:
        raise InputError(
            f"{where} has more than {LARGEST // 1_000_000} MB, too many to be read as JSON; check "
            "the name."
        )


def kind_of(value: object) -> str:
    """A value's kind in a sentence, such as "a list"."""
    return "null" if value is None else _KINDS.get(type(value), "a number")
