"""What workers are given in tests; they import it by name."""

import os
import signal


def squared(number: int) -> int:
    """The square; for 13 the process is killed, as by a system without memory."""
    if number == 13:
        os.kill(os.getpid(), signal.SIGKILL)
    return number * number


def failed(number: int, reason: str) -> str:
    """What stands for the square that will not come."""
    return f"{number}: {reason}"
