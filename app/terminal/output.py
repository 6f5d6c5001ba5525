"""Standard output as a terminal of people, where it is one."""

import sys
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from rich.console import Console


def terminal() -> "Console | None":
    """Standard output, None where it is no terminal, or one that cannot write a line over."""
    if not sys.stdout.isatty():
        return None
    from rich.console import Console

    # Whatever the environment says of colours in pipes: here is a terminal.
    console = Console(force_terminal=True, force_jupyter=False, highlight=False, markup=False)
    return None if console.is_dumb_terminal else console
