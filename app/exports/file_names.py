"""Names of files that the app writes."""

import re


def safe(name: str) -> str:
    """Replace all characters that some file systems reject."""
    return re.sub(r"[^A-Za-z0-9._-]+", "_", name)
