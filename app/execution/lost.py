"""What stands for the result of a worker that ended without one."""

from dataclasses import dataclass


@dataclass(frozen=True)
class Lost:
    """A result that will not come.

    Attributes:
        reason: a clause on why, without a full stop.
    """

    reason: str
