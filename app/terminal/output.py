"""Detection of a terminal on standard output."""

import sys
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from rich.console import Console


def terminal() -> "Console | None":
    """Console on standard output; None where that is no terminal, or cannot overwrite a line."""
    if sys.stdout is None or not sys.stdout.isatty():
        return None
    from rich.console import Console

    # The environment may ask for colours in pipes, too; this is known to be a terminal.
    console = Console(force_terminal=True, force_jupyter=False, highlight=False, markup=False)
    return None if console.is_dumb_terminal else console
