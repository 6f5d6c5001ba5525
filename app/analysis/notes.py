"""What to know of a recording before trusting what was computed from it."""

from recordings import Recording


def notes(recording: Recording) -> list[str]:
    """Sentences; some are found out only when frames are read."""
    said = list(recording.warnings)
    if recording.duplicates:
        said.append(f"Readings that came again, {recording.duplicates} of them, are left out.")
    if unplaced := int(recording.unplaced.sum()):
        said.append(
            f"{unplaced} of {len(recording)} frames are empty: they lie outside the "
            f"poses that are known."
        )
    return said
