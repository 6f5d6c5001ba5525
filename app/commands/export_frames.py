"""Frames of a recording that `tofscope export` is asked for."""

import argparse
from collections.abc import Sequence
from typing import TYPE_CHECKING

from app.errors import InputError
from estimator import Parameters

if TYPE_CHECKING:
    from app.analysis.estimates import Estimates
    from app.analysis.library import Opened


def frame_of(
    opened: "Opened", parameters: Parameters, options: argparse.Namespace, estimates: "Estimates"
) -> int:
    """The frame that is asked for, or one at which something moves.

    Raises:
        InputError: there is no such frame.
    """
    from app.analysis.first_frame import first_frame_with_flow

    frame = options.frame
    if frame is None:
        frame = first_frame_with_flow(opened, parameters, estimates)
    _check_frame(opened, frame)
    return frame


def frames_of(opened: "Opened", options: argparse.Namespace) -> range:
    """The frames that are asked for, or all.

    Raises:
        InputError: there are no such frames.
    """
    first, last = options.frames or (None, None)
    first = 0 if first is None else first
    last = len(opened.recording) - 1 if last is None else last
    _check_frame(opened, first)
    _check_frame(opened, last)
    if first > last:
        raise InputError(f"The last frame must not be before the first; got {first}:{last}.")
    return range(first, last + 1)


def _check_frame(opened: "Opened", frame: int) -> None:
    last = len(opened.recording) - 1
    if not 0 <= frame <= last:
        raise InputError(
            f"{opened.recording.name} has no frame {frame}: its frames are 0 to {last}."
        )


def frames_text(frames: Sequence[int], opened: "Opened") -> str:
    """Which frames of which recording, as a part of a sentence."""
    which = f"frames {frames[0]} to {frames[-1]}" if len(frames) > 1 else f"frame {frames[0]}"
    return f"{which} of {opened.recording.name}"
