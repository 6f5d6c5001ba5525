"""Choice of the frame that a recording opens at."""

import logging
import time
from collections.abc import Iterator, Sequence
from itertools import chain, islice

import numpy as np

from app.analysis.estimates import Estimates
from app.analysis.evaluation import counting_pairs
from app.analysis.library import Opened
from app.analysis.pairs import counts
from app.analysis.timeline import is_long
from app.errors import UserError
from estimator import Parameters
from recordings import Recording

_LOG = logging.getLogger(__name__)
_TRIED = 9  # frames at most
_SECONDS, _LONGEST = 1.5, 4.0
"""Limits of the search, so that opening stays quick: once something moves, and until then."""
_ENOUGH = 20  # moving points at which the search ends
_PROBES = 65  # frames of a long recording whose truth is looked at


def first_frame_with_flow(opened: Opened, parameters: Parameters, estimates: Estimates) -> int:
    """Find a frame with flow near the middle of the motion, among a few candidates.

    If none of them has flow, the one with most points.

    Args:
        opened: the recording.
        parameters: of the estimate.
        estimates: computes and caches flows.
    """
    tried = candidates(opened.recording, parameters.n)
    best, most, seen = next(tried), 0, 0
    start = time.monotonic()
    for frame in chain([best], tried):
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


def candidates(recording: Recording, n: int) -> Iterator[int]:
    """Frames to try, at least one, from the middle of the true motion outwards.

    Without truth, from the middle of the recording. The truth of a long recording is looked at in
    some of its frames alone, one after the other, as candidates are asked for.
    """
    every = range(min(n, len(recording) - 1), len(recording))
    if not is_long(recording):
        yield from _middle_first([k for _, k in counting_pairs(recording, n)] or every, _TRIED)
        return
    found = (k for k in _middle_first(every, _PROBES) if k >= n and counts(recording, k - n, k))
    first = next(found, None)
    if first is None:
        yield from _middle_first(every, _TRIED)
    else:
        yield from chain([first], islice(found, _TRIED - 1))


def _middle_first(frames: Sequence[int], most: int) -> list[int]:
    """The middle one of some frames and others, evenly spread, the nearest to it first."""
    spread = np.linspace(0, len(frames) - 1, most + 2).round().astype(int)[1:-1]
    middle = len(frames) // 2
    near_first = sorted({middle, *spread.tolist()}, key=lambda i: abs(i - middle))
    return [frames[i] for i in near_first[:most]]
