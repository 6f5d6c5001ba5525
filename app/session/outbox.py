"""Messages that a session sends to the browser exactly once."""

from dataclasses import dataclass
from pathlib import Path
from typing import Literal

Colour = Literal["red", "yellow", "green"]


@dataclass(frozen=True)
class Notice:
    """Notification in the corner of the page.

    Attributes:
        title: in bold.
        sentence: below the title.
        colour: None for the page's default.
        seconds: after which it closes.
        replaces: whether it replaces the last one of the same title.
    """

    title: str
    sentence: str
    colour: Colour | None = None
    seconds: float = 6.0
    replaces: bool = False


@dataclass(frozen=True)
class OpeningFailed:
    """A recording that could not be opened.

    Attributes:
        label: of the recording.
        reason: in sentences.
        path: of its file.
        kept: label of the recording that stays open, None without one.
    """

    label: str
    reason: str
    path: Path
    kept: str | None = None

    def notice(self) -> Notice:
        """What is said where another recording was opened instead."""
        return Notice(f"{self.label} cannot be opened", self.reason, "red", seconds=15.0)


@dataclass(frozen=True)
class Download:
    """File for the browser to download.

    Attributes:
        name: of the file.
        content: of the file.
    """

    name: str
    content: bytes


@dataclass(frozen=True)
class LinkToCopy:
    """Link for the clipboard: the page's address with this token."""

    token: str


@dataclass(frozen=True)
class EnlargePlots:
    """The plots are laid over the window, or put back."""


Message = Notice | OpeningFailed | Download | LinkToCopy | EnlargePlots
