"""Errors of robot descriptions and of rigs."""

from robot_assets.printable import printable


class SentenceError(Exception):
    """Error whose text is written for the user, in one line whatever names of files it holds."""

    def __str__(self) -> str:
        """Its text as it is told."""
        return printable(super().__str__())


class RobotError(SentenceError):
    """Robot description, or a mesh of it, that cannot be used."""
