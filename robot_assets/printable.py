"""Text of one line, without control characters."""


def printable(text: str) -> str:
    r"""One line in which control characters are escapes, such as \x1b or \n.

    Characters that turn the direction of writing, and bytes that are no text, are escapes, too.
    """
    return "".join(c if c.isprintable() else c.encode("unicode_escape").decode() for c in text)
