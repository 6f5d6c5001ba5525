"""The frame that a recording opens at."""

import time

import numpy as np

from app.analysis.estimates import Estimates
from app.analysis.evaluation import counting_pairs
from app.analysis.library import Opened
from estimator import Parameters
from recordings import Recording

_TRIED = 9  # frames, at most
_SECONDS = 1.5  # nobody likes to wait
_ENOUGH = 20  # moving points that tell something


def first_frame_with_flow(opened: Opened, parameters: Parameters, estimates: Estimates) -> int:
    """A frame with flow, as near to the middle of the motion as there is one among a few.

    Where none of them has flow, the one in which most is seen.

    Args:
        opened: the recording.
        parameters: of the estimate.
        estimates: computes and remembers.
    """
    tried = candidates(opened.recording, parameters.n)
    best, most, seen = tried[0], 0, 0
    end = time.monotonic() + _SECONDS
    for frame in tried:
        try:
            pair = estimates.estimated(opened, frame, parameters)
        except Exception:
            continue  # what is wrong with a frame is told when it is shown
        moving = int(pair.flow.moving.sum()) if pair.flow else 0
        if (moving, len(pair.target.points)) > (most, seen):
            best, most, seen = frame, moving, len(pair.target.points)
        if most >= _ENOUGH or time.monotonic() > end:
            break
    return best


def candidates(recording: Recording, n: int) -> list[int]:
    """Frames to try, from the middle of the motion outwards.

    Where no motion is known, it may be anywhere.
    """
    frames = [k for _, k in counting_pairs(recording, n)]
    frames = frames or list(range(min(n, len(recording) - 1), len(recording)))
    spread = np.linspace(0, len(frames) - 1, _TRIED + 2).round().astype(int)[1:-1]
    middle = len(frames) // 2
    near_first = sorted({middle, *spread.tolist()}, key=lambda i: abs(i - middle))
    return [frames[i] for i in near_first[:_TRIED]]
