"""What a person did wrong, or gave us, in one sentence each."""

from estimator import CloudError, ParameterError
from recordings import RecordingError
from robot_assets import RigError, RobotError


class InputError(Exception):
    """An argument or a path that cannot be used."""


UserError = (InputError, ParameterError, CloudError, RecordingError, RigError, RobotError)
"""Everything whose text is made for a person: shown as it is, without a traceback."""
