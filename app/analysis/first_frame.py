"""Choice of the frame that a recording opens at."""

import logging
import time

import numpy as np

from app.analysis.estimates import Estimates
from app.analysis.evaluation import counting_pairs
from app.analysis.library import Opened
from app.errors import UserError
from estimator import Parameters
from recordings import Recording

_LOG = logging.getLogger(__name__)
_TRIED = 9  # frames at most
_SECONDS, _LONGEST = 1.5, 4.0
"""Limits of the search, so that opening stays quick: once something moves, and until then."""
_ENOUGH = 20  # moving points at which the search ends


def first_frame_with_flow(opened: Opened, parameters: Parameters, estimates: Estimates) -> int:
    """Find a frame with flow near the middle of the motion, among a few candidates.

    If none of them has flow, the one with most points.

    Args:
        opened: the recording.
        parameters: of the estimate.
        estimates: computes and caches flows.
    """
    tried = candidates(opened.recording, parameters.n)
    best, most, seen = tried[0], 0, 0
    start = time.monotonic()
    for frame in tried:
        try:
            pair = estimates.estimated(opened, frame, parameters)
        except UserError:
            continue  # said once the frame is shown
        except Exception:
            _LOG.exception("%s: frame %d cannot be estimated", opened.recording.name, frame)
            continue
        moving = int(pair.flow.moving.sum()) if pair.flow else 0
        if (moving, len(pair.target.points)) > (most, seen):
            best, most, seen = frame, moving, len(pair.target.points)
        if most >= _ENOUGH or time.monotonic() - start > (_SECONDS if most else _LONGEST):
            break
    return best


def candidates(recording: Recording, n: int) -> list[int]:
    """Frames to try, from the middle of the true motion outwards.

    Without truth, from the middle of the recording.
    """
    frames = [k for _, k in counting_pairs(recording, n)]
    frames = frames or list(range(min(n, len(recording) - 1), len(recording)))
    spread = np.linspace(0, len(frames) - 1, _TRIED + 2).round().astype(int)[1:-1]
    middle = len(frames) // 2
    near_first = sorted({middle, *spread.tolist()}, key=lambda i: abs(i - middle))
    return [frames[i] for i in near_first[:_TRIED]]
