"""What can be wrong with a recording."""


class RecordingError(Exception):
    """A recording that cannot be used; one sentence says what, where, and what to do."""
