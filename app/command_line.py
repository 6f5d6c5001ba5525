"""The command `tofscope`: signals are handled before anything large is imported."""

import sys
from collections.abc import Sequence

from app.commands import signals


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command line and return its exit code.

    Args:
        arguments: of the command line; None: those of this process, which ends afterwards.
    """
    given = sys.argv[1:] if arguments is None else list(arguments)
    with signals.ending_at_once():
        from app.commands.running import run
    try:
        with signals.raising_keyboard_interrupt():
            code = run(given)
    except KeyboardInterrupt:
        code = signals.STOPPED
    finally:
        if arguments is None:
            signals.ignore()
    if arguments is None and signals.came():
        signals.end(code)
    return code
