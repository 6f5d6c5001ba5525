"""Terminal emulator: the screen that a program's output leaves."""

import re

_SEQUENCE = re.compile(r"\x1b\[([?0-9;]*)([A-Za-z])|(.)", re.DOTALL)


class Screen:
    """Lines of a terminal that is high enough never to scroll.

    Args:
        text: everything that was written.
        width: columns; a character beyond the last one begins a new line, as it does there.

    Attributes:
        lines: as they are in the end, without trailing blanks.
        cursor_visible: whether the cursor is to be seen in the end.
        styles: numbers of the styles that were set.
    """

    def __init__(self, text: str, width: int) -> None:
        self._rows: list[list[str]] = [[]]
        self._row = self._column = 0
        self._width = width
        self.cursor_visible = True
        self.styles: set[str] = set()
        for arguments, command, character in _SEQUENCE.findall(text):
            if command:
                self._obey(command, arguments)
            else:
                self._write(character)

    @property
    def lines(self) -> list[str]:
        found = ["".join(row).rstrip() for row in self._rows]
        while found and not found[-1]:
            found.pop()
        return found

    def _obey(self, command: str, arguments: str) -> None:
        if command == "A":
            self._row = max(0, self._row - int(arguments or 1))
        elif command == "K" and arguments == "2":
            self._rows[self._row] = []
        elif command in "lh" and arguments == "?25":
            self.cursor_visible = command == "h"
        elif command == "m":
            self.styles.update(arguments.split(";"))
        else:
            raise AssertionError(f"this terminal does not know {arguments}{command}")

    def _write(self, character: str) -> None:
        if character == "\r":
            self._column = 0
        elif character == "\n":
            self._down()
        else:
            assert character.isprintable(), f"{character!r} reached the terminal"
            if self._column == self._width:
                self._down()
            row = self._rows[self._row]
            row += [" "] * (self._column + 1 - len(row))
            row[self._column] = character
            self._column += 1

    def _down(self) -> None:
        self._row, self._column = self._row + 1, 0
        if self._row == len(self._rows):
            self._rows.append([])
