"""Messages that a session hands to the browser exactly once."""

from dataclasses import dataclass
from typing import Literal

Colour = Literal["red", "yellow", "green"]


@dataclass(frozen=True)
class Notice:
    """Notification in the corner of the page.

    Attributes:
        title: in bold.
        sentence: below it.
        colour: None for the page's own.
        seconds: after which it goes by itself.
        replaces: whether the last one of its title goes when it comes.
    """

    title: str
    sentence: str
    colour: Colour | None = None
    seconds: float = 6.0
    replaces: bool = False


@dataclass(frozen=True)
class Download:
    """File for the browser's downloads.

    Attributes:
        name: of the file.
        content: of the file.
    """

    name: str
    content: bytes


@dataclass(frozen=True)
class LinkToCopy:
    """Link for the clipboard: the page's own address with this token."""

    token: str


Message = Notice | Download | LinkToCopy
