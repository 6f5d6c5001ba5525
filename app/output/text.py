"""Text in files: as UTF-8, and in cells of tables that spreadsheets open."""

from typing import TypeVar

_T = TypeVar("_T")
_FORMULA = ("=", "+", "-", "@", "\t", "＝", "＋", "－", "＠")
"""Beginnings of a cell that a spreadsheet may compute, as OWASP lists them."""


def utf8(text: str) -> bytes:
    r"""Text as UTF-8; bytes of a file's name that are no text become escapes, such as \udcff."""
    return text.encode("utf-8", "backslashreplace")


def escaped(text: str) -> str:
    """Text with the escapes of `utf8`, for formats that encode it themselves."""
    return utf8(text).decode("utf-8")


def csv_cell(value: _T) -> _T | str:
    r"""Cell of a CSV file: a text that a spreadsheet would take for a formula begins with '.

    Names come from files of others. Numbers stay as they are, as texts, too. Line breaks become \r
    and \n: Python quotes no cell with a carriage return, and its rest would be a line of its own.
    """
    if not isinstance(value, str):
        return value
    try:
        float(value)
    except ValueError:
        text = value.replace("\r", "\\r").replace("\n", "\\n")
        return f"'{text}" if text.startswith(_FORMULA) else text
    return value
