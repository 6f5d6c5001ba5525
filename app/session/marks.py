"""Marks with notes that a person puts at frames, in a file beside the recording."""

import json
from collections.abc import Iterable
from dataclasses import dataclass, field
from pathlib import Path
from typing import Annotated, Literal

import numpy as np
from numpy.typing import NDArray
from pydantic import BaseModel, ConfigDict, Field, ValidationError

from app.errors import InputError
from app.output.checks import OutputKind, check_output
from app.output.writing import write

LONGEST_NOTE = 500
"""Characters of a note."""

_MOST = 10_000  # marks of a recording
_LARGEST = 10_000_000  # bytes of a file
_ENDING = ".marks.json"


@dataclass(frozen=True)
class Mark:
    """A mark at a frame.

    Attributes:
        frame: k.
        text: its note, "" without one.
    """

    frame: int
    text: str


class _Mark(BaseModel):
    model_config = ConfigDict(strict=True, allow_inf_nan=False)

    stamp: float
    text: Annotated[str, Field(max_length=LONGEST_NOTE)]


class _File(BaseModel):
    model_config = ConfigDict(strict=True)

    tofscope: Literal["marks"] = "marks"
    recording: str
    marks: Annotated[list[_Mark], Field(max_length=_MOST)]


def _is_marks(path: Path) -> bool:
    content = json.loads(path.read_bytes())
    return isinstance(content, dict) and content.get("tofscope") == "marks"


MARKS = OutputKind(".json", _is_marks)
"""File of a recording's marks."""


@dataclass
class Marks:
    """Marks of one recording; each change is written at once.

    They are kept by the frames' stamps, so that they stay in place when frames are told apart in
    another way.

    Attributes:
        path: of the recording.
        stamps: (K,) seconds of its frames.
        known: in the order of the frames; empty before `load`.
    """

    path: Path
    stamps: NDArray[np.float64]
    known: tuple[Mark, ...] = field(default=(), init=False)

    @property
    def file(self) -> Path:
        """Where they are kept: `<recording>.mcap.marks.json`."""
        return self.path.with_name(self.path.name + _ENDING)

    def load(self) -> None:
        """Read the marks that are kept, none where there is no file.

        Raises:
            InputError: the file cannot be read, or holds something else.
        """
        self.known = ()
        try:
            if not self.file.exists():
                return
            if self.file.stat().st_size > _LARGEST:
                raise InputError(f"{self.file} is too large for a file of marks.")
            content = _File.model_validate_json(self.file.read_bytes())
        except OSError as error:
            raise InputError(f"{self.file} cannot be read: {error.strerror}.") from error
        except ValidationError as error:
            raise InputError(
                f"{self.file} holds no marks of Tofscope; move it away to put marks here."
            ) from error
        self.known = self._sorted(
            Mark(self._frame(kept.stamp), kept.text) for kept in content.marks
        )

    def put(self, frame: int, text: str) -> None:
        """Put a mark at a frame, in place of the one that may be there.

        Raises:
            InputError: it cannot be kept.
        """
        frame = min(max(frame, 0), len(self.stamps) - 1)
        self._change(frame, [Mark(frame, text[:LONGEST_NOTE])])

    def remove(self, frame: int) -> None:
        """Remove the mark at a frame, if there is one.

        Raises:
            InputError: the file cannot be written.
        """
        self._change(frame, [])

    def _change(self, frame: int, instead: list[Mark]) -> None:
        self.load()  # another session may have put some meanwhile
        marks = self._sorted([*(mark for mark in self.known if mark.frame != frame), *instead])
        if len(marks) > _MOST:
            raise InputError(f"A recording has at most {_MOST:,} marks.")
        content = _File(
            recording=self.path.name,
            marks=[_Mark(stamp=float(self.stamps[m.frame]), text=m.text) for m in marks],
        )
        check_output(self.file, MARKS, [self.path])
        write(self.file, (content.model_dump_json(indent=2) + "\n").encode())
        self.known = marks

    def _frame(self, stamp: float) -> int:
        return int(np.argmin(np.abs(self.stamps - stamp)))

    @staticmethod
    def _sorted(marks: Iterable[Mark]) -> tuple[Mark, ...]:
        # The last of several at one frame counts.
        return tuple(sorted({m.frame: m for m in marks}.values(), key=lambda mark: mark.frame))
