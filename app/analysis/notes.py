"""Warnings about a recording's data, for readers of its results."""

from recordings import Recording


def notes(recording: Recording) -> list[str]:
    """Warnings as sentences; some arise only once frames are read."""
    sentences = list(recording.warnings)
    if recording.duplicates:
        sentences.append(f"{recording.duplicates} duplicate readings are left out.")
    if unplaced := int(recording.unplaced.sum()):
        sentences.append(
            f"{unplaced} of {len(recording)} frames are empty: no sensor's pose is known at "
            f"their time."
        )
    return sentences
