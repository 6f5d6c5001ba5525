"""The sensors of a recording: their intrinsics, and their readings in metres."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from recordings.contents import DEPTH_ENCODINGS, ZONES, Topic, Use, camera_matrix
from recordings.decoding import Decoder
from recordings.errors import RecordingError
from recordings.sensor_names import names_and_rings
from robot_assets import Rig, SensorModel, zone_rays
from robot_assets import Sensor as RigSensor

# ST's target status: 5 is valid, 9 valid with a large pulse (UM2884); others are no distance,
# even where the number looks plausible.
VALID_STATUS = (5, 9)


@dataclass(frozen=True)
class RecordedSensor:
    """A sensor of a recording.

    Attributes:
        name: of the rig's sensor, or the part of its topic that tells it apart.
        ring: name of its ring, "" where it has none.
        frame: its optical frame.
        directions: (8, 8, 3), a reading times its direction is the point in the optical frame.
        arrange: brings readings (8, 8) into the order of `directions`.
        limits: (smallest, largest) reading in metres that counts.
    """

    name: str
    ring: str
    frame: str
    directions: NDArray[np.float64]
    arrange: Callable[[NDArray[np.float64]], NDArray[np.float64]]
    limits: tuple[float, float]


def recorded_sensors(
    topics: list[Topic], decoder: Decoder, rig: Rig | None
) -> list[tuple[Topic, RecordedSensor, RigSensor | None]]:
    """Find the sensors of a recording.

    Intrinsics come from the CameraInfo with the image's frame, or beside it in the tree of topics.
    A rig that was given, or a recording without CameraInfo, takes them from the rig's model.

    Args:
        topics: of the file.
        decoder: of the file.
        rig: one that a person chose, None to use the recording's own intrinsics.

    Returns:
        For each depth topic its sensor, and the sensor of the rig that it matches by name.
    """
    infos = [topic for topic in topics if topic.use is Use.CAMERA_INFO]
    found: list[tuple[Topic, RecordedSensor, RigSensor | None]] = []
    depth = [topic for topic in topics if topic.use is Use.DEPTH]
    matches = [_sensor_of(rig, topic) if rig else None for topic in depth]
    names = names_and_rings([topic.name for topic in depth], matches)
    for topic, in_rig, (name, ring) in zip(depth, matches, names, strict=True):
        info = next((i for i in infos if i.frame == topic.frame), None) or next(
            (i for i in infos if parent(i.name) == parent(topic.name)), None
        )
        if rig and in_rig:
            sensor = _by_model(name, ring, topic.frame, rig.model)
        elif info:
            sensor = _by_camera_info(name, ring, topic.frame, decoder.decode(info.channel, 0))
        else:
            sensor = _by_model(name, "", topic.frame, SensorModel())
        found.append((topic, sensor, in_rig))
    return found


def readings(image: Any, status: Any | None, sensor: RecordedSensor) -> NDArray[np.float64]:  # noqa: ANN401
    """The readings (8, 8) in metres of a depth image, NaN where there is none.

    16 bit images hold millimetres with 0 for invalid, 32 bit ones metres with NaN (REP 118).
    A recording's first image told that it is one of these; a later one may still be another.

    Args:
        image: sensor_msgs/Image.
        status: sensor_msgs/Image with ST's target status of the same reading, None without.
        sensor: that it is from.

    Raises:
        RecordingError: the image is no depth image, or has fewer bytes than its size says.
    """
    if (image.height, image.width) != ZONES or image.encoding not in DEPTH_ENCODINGS:
        raise RecordingError(
            f"An image of {image.header.frame_id} is {image.width} x {image.height} in "
            f"{image.encoding!r}, and not {ZONES[1]} x {ZONES[0]} distances."
        )
    kind = np.dtype(np.float32 if image.encoding == "32FC1" else np.uint16)
    values = pixels(image, kind).astype(np.float64)
    if kind == np.uint16:
        values /= 1000.0
    with np.errstate(invalid="ignore"):
        valid = np.isfinite(values) & (values > 0)
    if status is not None:
        valid &= np.isin(pixels(status, np.dtype(np.uint8)), VALID_STATUS)
    values = sensor.arrange(np.where(valid, values, np.nan))
    low, high = sensor.limits
    with np.errstate(invalid="ignore"):
        return np.where((values >= low) & (values <= high), values, np.nan)


def pixels(image: Any, kind: np.dtype[Any]) -> NDArray[Any]:  # noqa: ANN401
    """The pixels (8, 8) of an image as numbers of a kind.

    Raises:
        RecordingError: the image has fewer bytes than its size says.
    """
    rows, columns = ZONES
    needed = (rows - 1) * image.step + columns * kind.itemsize
    if image.step < columns * kind.itemsize or len(image.data) < needed:
        raise RecordingError(
            f"An image of {image.header.frame_id} has {len(image.data)} bytes in rows of "
            f"{image.step}, too few for {columns} x {rows} zones in {image.encoding}."
        )
    order = ">" if image.is_bigendian else "<"
    data = np.frombuffer(bytes(image.data), dtype=np.uint8)
    lines = [data[r * image.step : r * image.step + columns * kind.itemsize] for r in range(rows)]
    return np.stack(lines).view(kind.newbyteorder(order)).astype(kind)


def parent(topic: str) -> str:
    """The topic one level up: "/tof/base/0" of "/tof/base/0/image"."""
    return topic.rsplit("/", 1)[0]


def _sensor_of(rig: Rig, topic: Topic) -> RigSensor | None:
    """The sensor of a rig whose name stands in the topic or in its frame."""
    texts = [f"_{_plain(text)}_" for text in (parent(topic.name), topic.frame)]
    fitting = [s for s in rig.sensors if any(f"_{_plain(s.name)}_" in text for text in texts)]
    return max(fitting, key=lambda s: len(s.name), default=None)


def _plain(text: str) -> str:
    return "_".join("".join(c if c.isalnum() else " " for c in text.lower()).split())


def _by_model(name: str, ring: str, frame: str, model: SensorModel) -> RecordedSensor:
    return RecordedSensor(
        name, ring, frame, model.directions, model.arrange, (model.min_range, model.max_range)
    )


def _by_camera_info(name: str, ring: str, frame: str, info: Any) -> RecordedSensor:  # noqa: ANN401
    # REP 118: a depth image holds distances along the optical axis, in the order of the optical
    # frame, so the camera matrix is all that is needed.
    fx, fy, cx, cy = camera_matrix(info)
    rows, columns = ZONES
    return RecordedSensor(
        name=name,
        ring=ring,
        frame=frame,
        directions=zone_rays(rows, columns, fx=fx, fy=fy, cx=cx, cy=cy),
        arrange=lambda values: values,
        limits=(0.0, np.inf),
    )


@dataclass(frozen=True)
class DepthStream:
    """The images of one sensor.

    Attributes:
        topic: of the depth images.
        sensor: that they are from.
        status: topic of the target status beside them, None without.
        status_index: index of the status message of each depth message, -1 where it has none.
    """

    topic: Topic
    sensor: RecordedSensor
    status: Topic | None
    status_index: NDArray[np.int64]


def depth_stream(
    topic: Topic, sensor: RecordedSensor, topics: list[Topic], decoder: Decoder
) -> DepthStream:
    """Join a sensor's depth images with the status of the same readings, by their stamps."""
    status = next(
        (t for t in topics if t.use is Use.STATUS and parent(t.name) == parent(topic.name)), None
    )
    stamps = decoder.header_stamps(topic.channel)
    index = np.full(len(stamps), -1, dtype=np.int64)
    if status is not None:
        row_of = {int(t): row for row, t in enumerate(decoder.header_stamps(status.channel))}
        index[:] = [row_of.get(int(t), -1) for t in stamps]
    return DepthStream(topic, sensor, status, index)
