"""Errors of robot descriptions."""


class RobotError(Exception):
    """Robot description, or a mesh of it, that cannot be used."""
