"""Poses of /tf as they are read, and at the frames of a recording."""

from collections.abc import Iterator, Mapping
from functools import partial

from recordings.decoding import Decoder
from recordings.errors import RecordingError
from recordings.layouts import Samples, all_samples
from recordings.mcap_contents import ChannelInfo
from recordings.message_kinds import TRANSFORMS
from recordings.nearby import FramePlaces, Nearby
from recordings.tracks import PoseTrack, Stamps, last_poses, pose_tracks
from robot_assets import Transform

MOST_POSES = 2**22
"""Poses of moving frames times frames of a recording: 500 MB."""


class Parents:
    """Parents of frames as they are found; of several the first counts.

    Attributes:
        first: {frame: its parent}.
        others: {frame: another parent}.
    """

    def __init__(self) -> None:
        self.first: dict[str, str] = {}
        self.others: dict[str, str] = {}

    def number(self, numbers: dict[str, int], edge: tuple[str, str]) -> int:
        """Number of a frame, a new one where it has none; -1 where the parent is not its first.

        Args:
            numbers: {frame: its number}, to which it is added.
            edge: frame and parent.
        """
        child, parent = edge
        if self.first.setdefault(child, parent) != parent:
            self.others.setdefault(child, parent)
            return -1
        return numbers.setdefault(child, len(numbers))


class TransformSamples:
    """Poses of frames as they are read.

    Args:
        parents: of the frames; those found are added.
    """

    def __init__(self, parents: Parents) -> None:
        self._parents = parents
        self._numbers: dict[str, int] = {}
        self._parts: list[Samples] = []

    def add(self, decoder: Decoder, channel: ChannelInfo) -> None:
        """Add all poses of a channel."""
        number = partial(self._parents.number, self._numbers)
        self._parts.append(all_samples(decoder, channel, TRANSFORMS, number))

    def add_ends(self, places: FramePlaces, channel: ChannelInfo) -> None:
        """Add the poses in the first and the last chunks of a long recording."""
        number = partial(self._parents.number, self._numbers)
        self._parts.append(Nearby(places, channel, TRANSFORMS, number).ends)

    def tracks(self) -> dict[str, PoseTrack]:
        """{frame: its track} of the frames with a usable pose."""
        found = Samples.joined(self._parts, TRANSFORMS.width)
        tracks = pose_tracks(found.of, found.stamps, found.values[:, :3], found.values[:, 3:])
        return {name: tracks[n] for name, n in self._numbers.items() if n in tracks}


class WholePoses(Mapping[str, Transform]):
    """Poses of frames at the frames of a recording, computed where they are asked for.

    Args:
        fixed: {frame: track} of /tf_static, whose last pose counts.
        moving: {frame: track} of /tf; a frame in both counts as moving.
        stamps: (K,) nanoseconds of the recording's frames.
    """

    def __init__(
        self, fixed: Mapping[str, PoseTrack], moving: Mapping[str, PoseTrack], stamps: Stamps
    ) -> None:
        self._moving, self._stamps, self._computed = moving, stamps, 0
        self._known = dict(zip(fixed, last_poses(list(fixed.values()))[:, None], strict=True))
        for frame in moving:
            self._known.pop(frame, None)

    def __getitem__(self, frame: str) -> Transform:
        """Poses of a frame; RecordingError where there are too many."""
        if frame not in self._known:
            self._computed += 1
            if self._computed * len(self._stamps) > MOST_POSES:
                raise RecordingError(
                    f"/tf moves more than {self._computed - 1} frames that place the sensors, "
                    f"and there may be {MOST_POSES} poses; give the file in parts."
                )
            self._known[frame] = self._moving[frame].at(self._stamps)
        return self._known[frame]

    def __iter__(self) -> Iterator[str]:
        return iter({**self._known, **self._moving})

    def __len__(self) -> int:
        return len({**self._known, **self._moving})
