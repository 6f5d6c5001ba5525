"""Warnings about a recording's data, for readers of its results."""

from recordings import Recording

NO_TRUTH = "has no truth, so there is nothing to compare with"


def truth_frame_note(frame: str) -> str:
    """What numbers are worth with a truth frame."""
    return (
        "coverage, precision, EPE3D and the other metrics of points assume that every point moves "
        f"with {frame}"
    )


def no_pair_note(n: int) -> str:
    """Why there are no errors, to follow "has"."""
    return f"no pair that counts: the object must move at both frames k-n and k, and n is {n}"


def all_notes(recording: Recording) -> list[str]:
    """All that a reader must know of a recording, also of its truth."""
    sentences = notes(recording)
    if not recording.has_truth:
        sentences.append(f"The recording {NO_TRUTH}.")
    elif recording.truth_frame is not None:
        note = truth_frame_note(recording.truth_frame)
        sentences.append(f"{note[0].upper()}{note[1:]}.")
    return sentences


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
