"""Uses of a file's topics, decided by type and content; names are hints."""

import re
from dataclasses import dataclass, replace
from enum import StrEnum
from typing import Any

import numpy as np

from recordings.decoding import Decoder
from recordings.grids import SIZES, Grid, is_grid, size_text
from recordings.mcap_contents import ChannelInfo
from recordings.mcap_file import McapFile
from recordings.range_formats import range_format

_STATUS_ENCODINGS = ("8UC1", "mono8")
TRUTH_FIELDS = {"x", "y", "z", "vx", "vy", "vz", "object"}
"""Fields of a cloud with the truth of points."""
_TRUTH_NAMES = ("target", "truth")
_LEAST_FOCAL, _LARGEST_FOCAL = 1e-2, 1e6
"""Zones: two of them would see nearly half the space around a sensor, or a point."""
_LONGEST_NAME = 1000  # characters of a topic


class Use(StrEnum):
    """Use of a topic."""

    DEPTH = "sensor ranges"
    STATUS = "sensor status"
    CAMERA_INFO = "sensor intrinsics"
    TRANSFORMS = "poses"
    STATIC_TRANSFORMS = "fixed poses"
    JOINTS = "joint positions"
    ROBOT = "robot description"
    VELOCITY = "truth: velocity"
    POSE = "truth: pose"
    POINTS = "truth: points"
    NOTHING = "not used"


_WITH_GRID = (Use.STATUS, Use.CAMERA_INFO)


@dataclass(frozen=True)
class Topic:
    """A channel and its use.

    Attributes:
        channel: of the file.
        use: of the topic.
        why_not: reason why it is not used, "" where it is.
        frame: frame_id of its first message, "" where its type has no header.
        candidate: whether it is one of several topics that could be the truth.
        grid: size of its first image, or of the images that its intrinsics are for.
        damaged: whether it could be of use, but its messages or their schema do not fit its type.
    """

    channel: ChannelInfo
    use: Use
    why_not: str = ""
    frame: str = ""
    candidate: bool = False
    grid: Grid | None = None
    damaged: bool = False

    @property
    def name(self) -> str:
        """The topic's name."""
        return self.channel.topic


def topics_of(file: McapFile, decoder: Decoder) -> list[Topic]:
    """Find the use of every channel of a file, in the natural order of topics."""
    channels = sorted(file.channels, key=lambda c: natural_key(c.topic))
    topics = [_topic(channel, file, decoder) for channel in channels]
    for use in (Use.VELOCITY, Use.POSE, Use.POINTS):
        topics = _one_truth(topics, use)
    return _status_beside_ranges(topics)


def parent(topic: str) -> str:
    """The topic one level up: "/tof/base/0" of "/tof/base/0/image"."""
    return topic.rsplit("/", 1)[0]


def _status_beside_ranges(topics: list[Topic]) -> list[Topic]:
    """Reject status images without ranges of the same size beside them."""
    ranges = {(parent(topic.name), topic.grid) for topic in topics if topic.use is Use.DEPTH}
    why_not = "there are no ranges of its size beside it"
    return [
        replace(topic, use=Use.NOTHING, why_not=why_not)
        if topic.use is Use.STATUS and (parent(topic.name), topic.grid) not in ranges
        else topic
        for topic in topics
    ]


def _one_truth(topics: list[Topic], use: Use) -> list[Topic]:
    """Keep one topic for a use: the one named as truth, or the only one."""
    candidates = [topic for topic in topics if topic.use is use]
    named = [topic for topic in candidates if named_truth(topic.name)]
    if len(candidates) == 1 or len(named) == 1:
        chosen = (named or candidates)[0]
        why_not = f"{chosen.name} is used as the {use}"
    else:
        chosen = None
        why_not = f"{len(candidates)} topics could be the {use}, and not one is named as it"
    return [
        topic
        if topic.use is not use or topic is chosen
        else replace(topic, use=Use.NOTHING, why_not=why_not, candidate=chosen is None)
        for topic in topics
    ]


def natural_key(text: str) -> list[tuple[int, int, str]]:
    """Sort key that puts "ring/10" after "ring/9"."""
    key: list[tuple[int, int, str]] = []
    for run in re.findall(r"[0-9]+|[^0-9]+", text):
        # Not as numbers, which Python reads of 4300 digits at most.
        digits = run.lstrip("0")
        key.append((0, len(digits), digits) if run[0] in "0123456789" else (1, 0, run))
    return key


def _topic(channel: ChannelInfo, file: McapFile, decoder: Decoder) -> Topic:
    kind = channel.schema_name.replace("/msg/", "/")
    if why_not := _unusable(channel, kind, file, decoder):
        return Topic(channel, Use.NOTHING, why_not)
    if misfit := decoder.misfit(channel):
        return Topic(channel, Use.NOTHING, f"it does not fit its type: {misfit}", damaged=True)
    if kind == _TRANSFORMS:
        # Decided by the name alone: a message may hold very many.
        static = channel.topic.endswith("tf_static")
        return Topic(channel, Use.STATIC_TRANSFORMS if static else Use.TRANSFORMS)
    first = decoder.first(channel)
    if first is None:
        return Topic(channel, Use.NOTHING, "its messages do not fit its type", damaged=True)
    return _by_content(channel, kind, first)


def _unusable(channel: ChannelInfo, kind: str, file: McapFile, decoder: Decoder) -> str:
    """Why a channel cannot be used whatever its messages hold, "" where it may be."""
    if kind not in (_TRANSFORMS, *_BY_TYPE) and range_format(kind) is None:
        return f"{channel.schema_name or 'its type'} is not needed"
    if len(channel.topic) > _LONGEST_NAME:
        return "its name is too long"
    if not decoder.can_decode(channel):
        encoding = f"{channel.encoding} with schema {channel.schema_encoding or 'none'}"
        return f"its encoding ({encoding}) cannot be read"
    return "" if len(file.table(channel)) else "it has no messages"


def _by_content(channel: ChannelInfo, kind: str, first: Any) -> Topic:  # noqa: ANN401
    """The use of a channel of a known type, by its first message."""
    frame = first.header.frame_id.lstrip("/") if hasattr(first, "header") else ""
    use = _BY_TYPE[kind](channel.topic, first) if kind in _BY_TYPE else ""
    if isinstance(use, Use):
        grid = (first.height, first.width) if use in _WITH_GRID else None
        return Topic(channel, use, frame=frame, grid=grid)
    ranges = range_format(kind)
    found = ranges.grid(first) if ranges else ""
    if isinstance(found, str):
        return Topic(channel, Use.NOTHING, "; ".join(filter(None, (use, found))), frame)
    return Topic(channel, Use.DEPTH, frame=frame, grid=found)


def _image(topic: str, image: Any) -> Use | str:  # noqa: ANN401 (a decoded message)
    is_status = is_grid(image.height, image.width) and image.encoding in _STATUS_ENCODINGS
    return Use.STATUS if is_status else ""  # or ranges, whose format says why it is none


def _camera_info(topic: str, info: Any) -> Use | str:  # noqa: ANN401
    if not is_grid(info.height, info.width):
        return f"it is for {size_text((info.height, info.width))}, and a sensor has {SIZES}"
    fx, fy, cx, cy = camera_matrix(info)
    if not all(_LEAST_FOCAL <= f <= _LARGEST_FOCAL for f in (fx, fy)):
        return f"its focal lengths are {fx:g} and {fy:g} zones"
    if not all(abs(c) <= _LARGEST_FOCAL for c in (cx, cy)):
        return f"its optical axis is at {cx:g}, {cy:g}"
    return Use.CAMERA_INFO


def _text(topic: str, message: Any) -> Use | str:  # noqa: ANN401
    is_urdf = "<robot" in message.data[:4096]
    return Use.ROBOT if is_urdf else "it is a text, and not a robot description"


def _pose(topic: str, message: Any) -> Use | str:  # noqa: ANN401
    # Robots publish poses of many things; only the name identifies the truth.
    return Use.POSE if named_truth(topic) else "its name does not say that it is the truth"


def named_truth(topic: str) -> bool:
    """Whether a topic's name says that it is the truth."""
    return any(name in topic.lower() for name in _TRUTH_NAMES)


def _points(topic: str, cloud: Any) -> Use | str:  # noqa: ANN401
    names = {field.name for field in cloud.fields}
    if missing := sorted(TRUTH_FIELDS - names):
        return f"it lacks {', '.join(missing)}, which the truth of points needs"
    return Use.POINTS


_TRANSFORMS = "tf2_msgs/TFMessage"
_BY_TYPE = {
    "sensor_msgs/Image": _image,
    "sensor_msgs/CameraInfo": _camera_info,
    "sensor_msgs/JointState": lambda topic, message: Use.JOINTS,
    "sensor_msgs/PointCloud2": _points,
    "std_msgs/String": _text,
    "geometry_msgs/TwistStamped": lambda topic, message: Use.VELOCITY,
    "geometry_msgs/PoseStamped": _pose,
}


def camera_matrix(info: Any) -> tuple[float, float, float, float]:  # noqa: ANN401
    """(fx, fy, cx, cy) of a CameraInfo, in zones."""
    k = np.asarray(info.k, dtype=np.float64)
    return float(k[0]), float(k[4]), float(k[2]), float(k[5])
