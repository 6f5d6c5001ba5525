"""Joint positions in a long recording, read around the frames that are asked for."""

from functools import lru_cache, partial

import numpy as np
from numpy.typing import NDArray

from recordings.contents import Topic
from recordings.message_kinds import JOINTS
from recordings.nearby import Column, FramePlaces, Nearby
from recordings.tracks import vector_tracks
from robot_assets import JointMatch

_CACHED_BLOCKS = 64


class JointsNearby:
    """Positions of the joints of one topic around frames of a recording.

    Which joints there are is known from the first and the last chunks.

    Args:
        topic: of type JointState.
        places: of the recording's frames.
        match: of recorded names to joints.
    """

    def __init__(self, topic: Topic, places: FramePlaces, match: JointMatch) -> None:
        self._places = places
        self._numbers: dict[str, int] = {}

        def number(name: str) -> int:
            joint = match.joints.get(name)
            return -1 if joint is None else self._numbers.setdefault(joint, len(self._numbers))

        self._source = Nearby(places, topic.channel, JOINTS, number)
        self._block = lru_cache(maxsize=_CACHED_BLOCKS)(self._of_block)

    def columns(self) -> dict[str, Column]:
        """{joint: rad or m at the frames of the recording, NaN where unknown}."""
        ends, stamps = self._source.ends, self._places.stamps
        tracks = vector_tracks(ends.of, ends.stamps, ends.values)
        return {
            joint: Column(partial(self._at, n), tracks[n].covers(stamps), tracks[n].values[:, 0])
            for joint, n in self._numbers.items()
            if n in tracks
        }

    def _at(self, number: int, k: int) -> np.float64:
        first, last = self._places.block(k)
        return self._block(first, last)[number, k - first]

    def _of_block(self, first: int, last: int) -> NDArray[np.float64]:
        """Positions (joints, frames) at a block of frames."""
        stamps, found = self._places.stamps[first : last + 1], self._source.around(first, last)
        positions = np.full((len(self._numbers), len(stamps)), np.nan)
        for n, track in vector_tracks(found.of, found.stamps, found.values).items():
            positions[n] = track.at(stamps)[:, 0]
        return positions
