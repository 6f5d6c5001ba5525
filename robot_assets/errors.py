"""What can be wrong with a robot."""


class RobotError(Exception):
    """A robot description, or a mesh of it, that cannot be used; one sentence says why."""
