"""Errors that are reported to the user in one sentence, without a traceback."""

from estimator import CloudError, MethodError, ParameterError
from recordings import RecordingError
from robot_assets import RigError, RobotError


class InputError(Exception):
    """An argument or a path that cannot be used."""


UserError = (
    InputError,
    ParameterError,
    MethodError,
    CloudError,
    RecordingError,
    RigError,
    RobotError,
)
"""Errors whose text is written for the user and shown as it is."""
