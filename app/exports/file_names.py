"""Names for files that the app makes."""

import re


def safe(name: str) -> str:
    """The name with whatever not every file system takes replaced."""
    return re.sub(r"[^A-Za-z0-9._-]+", "_", name)
