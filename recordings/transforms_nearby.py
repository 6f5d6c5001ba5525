"""Poses of /tf in a long recording, read around the frames that are asked for."""

from collections.abc import Sequence
from functools import lru_cache, partial

import numpy as np
from numpy.typing import NDArray

from recordings.contents import Topic
from recordings.layouts import Samples
from recordings.message_kinds import TRANSFORMS
from recordings.nearby import Column, FramePlaces, Nearby
from recordings.tracks import PoseTrack, pose_tracks
from recordings.transform_samples import Parents

_CACHED_BLOCKS = 64


class TransformsNearby:
    """Tracks of the moving frames of /tf around frames of a recording.

    Which frames there are, and their parents, is known from the first and the last chunks.

    Args:
        topics: of type TFMessage.
        places: of the recording's frames.
        parents: of frames known before; those found here are added.
    """

    def __init__(
        self,
        topics: Sequence[Topic],
        places: FramePlaces,
        parents: Parents,
    ) -> None:
        self._places = places
        self._numbers: dict[str, int] = {}

        number = partial(parents.number, self._numbers)
        self._sources = [Nearby(places, topic.channel, TRANSFORMS, number) for topic in topics]
        self._block = lru_cache(maxsize=_CACHED_BLOCKS)(self._poses_of_block)

    def columns(self) -> dict[str, Column]:
        """{frame: its poses (4, 4) at the frames of the recording} of frames with a usable pose."""
        ends, stamps = _tracks([source.ends for source in self._sources]), self._places.stamps
        return {
            frame: Column(
                partial(self._at, n),
                (stamps >= ends[n].stamps[0]) & (stamps <= ends[n].stamps[-1]),
            )
            for frame, n in self._numbers.items()
            if n in ends
        }

    def _at(self, number: int, k: int) -> NDArray[np.float64]:
        first, last = self._places.block(k)
        return self._block(first, last)[number, k - first]

    def _poses_of_block(self, first: int, last: int) -> NDArray[np.float64]:
        """Poses (frames of /tf, frames, 4, 4) of a block of frames, NaN where unknown."""
        stamps = self._places.stamps[first : last + 1]
        poses = np.full((len(self._numbers), len(stamps), 4, 4), np.nan)
        tracks = _tracks([source.around(first, last) for source in self._sources])
        for number, track in tracks.items():
            poses[number] = track.near(stamps).at(stamps)
        return poses


def _tracks(samples: list[Samples]) -> dict[int, PoseTrack]:
    joined = Samples.joined(samples, TRANSFORMS.width)
    return pose_tracks(joined.of, joined.stamps, joined.values[:, :3], joined.values[:, 3:])
