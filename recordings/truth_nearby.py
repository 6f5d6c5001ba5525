"""Truth of the moving object in a long recording, read around the frames that are asked for."""

from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from recordings.layouts import Samples
from recordings.mcap_contents import ChannelInfo
from recordings.message_kinds import POSE, TWIST
from recordings.nearby import Column, FramePlaces, Nearby
from recordings.tracks import VectorTrack, pose_track, vector_track
from recordings.velocity_record import VELOCITIES, unpack_velocities

TURNING = 1e-3
"""Angular velocity, rad/s, from which on an object rotates."""
_CACHED_BLOCKS = 64


class TwistNearby:
    """Recorded velocity around frames; otherwise as `VectorsAtFrames`.

    Args:
        channel: of type TwistStamped.
        places: of the recording's frames.
        rotation: (3, 3), takes velocities into the fixed frame.
    """

    def __init__(
        self, channel: ChannelInfo, places: FramePlaces, rotation: NDArray[np.float64]
    ) -> None:
        self._places, self._channel, self._rotation = places, channel, rotation
        self._source = Nearby(places, channel, TWIST, lambda _: 0)
        self._track = lru_cache(maxsize=_CACHED_BLOCKS)(self._track_of)

    @property
    def usable(self) -> bool:
        """Whether the first or the last chunks have a finite velocity."""
        return vector_track(self._source.ends.stamps, self._source.ends.values[:, :3]) is not None

    def all_samples(self) -> Samples | None:
        """All velocities, m/s and rad/s, by the file's record of them; None without.

        A record that does not fit the first and the last message is not used.
        """
        file, ends = self._places.file, self._source.ends
        stamps = self._places.decoder.header_stamps(self._channel)
        data = file.attachment(VELOCITIES)
        values = None if data is None else unpack_velocities(data, len(stamps))
        if values is None or len(ends.values) == 0:
            return None
        if not np.array_equal(values[[0, -1]], ends.values[[0, -1]]):
            return None
        return Samples(np.zeros(len(stamps), np.int64), stamps, values)

    def at_frame(self, k: int) -> NDArray[np.float64]:
        """Velocity (3,) m/s at a frame, NaN where unknown."""
        track, _ = self._track(*self._places.block(k))
        return np.full(3, np.nan) if track is None else track.at(self._places.stamps[[k]])[0]

    def mean(self, source_k: int, target_k: int) -> NDArray[np.float64]:
        """Mean velocity (3,) m/s over the time between two frames, NaN where unknown."""
        track, _ = self._track(source_k, target_k)
        stamps = self._places.stamps
        if track is None:
            return np.full(3, np.nan)
        return track.mean(int(stamps[source_k]), int(stamps[target_k]))

    def turns(self, source_k: int, target_k: int) -> bool:
        """Whether there is an angular velocity around two frames and between them."""
        return self._track(source_k, target_k)[1]

    def _track_of(self, first: int, last: int) -> tuple[VectorTrack | None, bool]:
        found = self._source.around(min(first, last), max(first, last))
        track = vector_track(found.stamps, found.values[:, :3])
        turns = bool((np.abs(found.values[:, 3:]) > TURNING).any())
        return track.rotated(self._rotation) if track else None, turns


class PosesOfTopic:
    """Recorded pose around frames.

    Args:
        channel: of type PoseStamped.
        places: of the recording's frames.
    """

    def __init__(self, channel: ChannelInfo, places: FramePlaces) -> None:
        self._places = places
        self._source = Nearby(places, channel, POSE, lambda _: 0)
        self._block = lru_cache(maxsize=_CACHED_BLOCKS)(self._of_block)

    def column(self) -> Column | None:
        """Poses (4, 4) at the frames, NaN where unknown; None where the ends have none."""
        ends, stamps = self._source.ends, self._places.stamps
        track = pose_track(ends.stamps, ends.values[:, :3], ends.values[:, 3:])
        if track is None:
            return None
        return Column(self._at, (stamps >= track.stamps[0]) & (stamps <= track.stamps[-1]))

    def _at(self, k: int) -> NDArray[np.float64]:
        first, last = self._places.block(k)
        return self._block(first, last)[k - first]

    def _of_block(self, first: int, last: int) -> NDArray[np.float64]:
        stamps, found = self._places.stamps[first : last + 1], self._source.around(first, last)
        track = pose_track(found.stamps, found.values[:, :3], found.values[:, 3:])
        return np.full((len(stamps), 4, 4), np.nan) if track is None else track.at(stamps)
