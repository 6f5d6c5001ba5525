"""Text of one line, without control characters, of bounded length."""

import re

_LONGEST_WORD, _LONGEST_TEXT = 500, 4000
"""Characters that are shown of a name, and of a sentence with names in it."""
_END = 100
"""Characters that are left at each end of what is cut short."""


def printable(text: str) -> str:
    r"""One line in which control characters are escapes, such as \x1b or \n.

    Characters that turn the direction of writing, and bytes that are no text, are escapes, too. A
    very long name, as only files of others have them, loses its middle.
    """
    if len(text) > _LONGEST_WORD:
        text = re.sub(rf"\S{{{_LONGEST_WORD + 1},}}", lambda word: _cut(word[0]), text)
        text = _cut(text) if len(text) > _LONGEST_TEXT else text
    return "".join(c if c.isprintable() else c.encode("unicode_escape").decode() for c in text)


def _cut(text: str) -> str:
    return f"{text[:_END]}...{text[-_END:]}"
