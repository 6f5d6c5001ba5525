"""Sensors of a recording: intrinsics, and readings in metres."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from recordings.contents import Topic, Use, camera_matrix, parent
from recordings.decoding import Decoder
from recordings.depth_images import DEPTH_IMAGE, pixels
from recordings.errors import MisfitError, RecordingError
from recordings.grids import Grid, size_text
from recordings.range_format import RangeFormat
from recordings.range_formats import range_format
from recordings.rig_record import depth_topic, topic_part
from recordings.sensor_names import names_and_rings
from robot_assets import Rig, SensorModel, plain_name, zone_rays
from robot_assets import Sensor as RigSensor

# ST's target status: 5 is valid, 9 valid with a large pulse (UM2884); with any other the reading is
# no distance, however plausible.
VALID_STATUS = (5, 9)
_IS_VALID = np.isin(np.arange(256), VALID_STATUS)
MOST_SENSORS = 1024
"""Sensors of a recording; one with more is refused, as with more zones."""
MOST_ZONES = 2**18
"""Zones of all sensors of a recording, such as 64 sensors of 64 x 64."""


@dataclass(frozen=True)
class RecordedSensor:
    """Sensor of a recording.

    Attributes:
        name: of the rig's sensor, or the distinguishing part of its topic.
        ring: name of its ring, "" where it has none.
        frame: its optical frame.
        directions: (rows, columns, 3), a reading times its direction is the point in the optical
            frame.
        arrange: reorders readings of an image into the order of `directions`.
        limits: (smallest, largest) valid reading in metres.
        images: rows and columns of its images where they are not those of `directions`.
    """

    name: str
    ring: str
    frame: str
    directions: NDArray[np.float64]
    arrange: Callable[[NDArray[Any]], NDArray[Any]]
    limits: tuple[float, float]
    images: Grid | None = None

    @property
    def grid(self) -> Grid:
        """Rows and columns of zones."""
        return self.directions.shape[0], self.directions.shape[1]


def recorded_sensors(
    topics: list[Topic], decoder: Decoder, rig: Rig | None, own: Rig | None = None
) -> list[tuple[Topic, RecordedSensor, RigSensor | None]]:
    """Find the sensors of a recording.

    Intrinsics are those of the chosen rig, else of the CameraInfo with the image's frame or beside
    it in the tree of topics, else of the messages, else a field of view of 45 degrees.

    Args:
        topics: of the file.
        decoder: of the file.
        rig: the user's choice, None to use the recording's own intrinsics.
        own: the rig in the file, which names the sensors.

    Returns:
        For each depth topic its sensor, and the sensor of the rig that it matches by name.

    Raises:
        RecordingError: there are too many of them.
    """
    depth = [topic for topic in topics if topic.use is Use.DEPTH]
    zones = sum(rows * columns for rows, columns in map(_grid, depth))
    if len(depth) > MOST_SENSORS or zones > MOST_ZONES:
        raise RecordingError(
            f"The recording has {len(depth)} sensors with {zones} zones, more than {MOST_SENSORS} "
            f"sensors or {MOST_ZONES} zones."
        )
    infos = _Infos(topics)
    named_by = {depth_topic(topic_part(s.name)): s for s in own.sensors} if own else {}
    found: list[tuple[Topic, RecordedSensor, RigSensor | None]] = []
    matches = [_sensor_of(rig, topic) if rig else None for topic in depth]
    own_sensors = [named_by.get(topic.name) for topic in depth]
    names = names_and_rings([topic.name for topic in depth], matches, own_sensors)
    for topic, in_rig, (name, ring) in zip(depth, matches, names, strict=True):
        info = next((i for i in infos.of(topic) if i.grid == topic.grid), None)
        if rig and in_rig:
            sensor = _by_model(name, ring, topic, rig.model)
        elif info:
            sensor = _by_camera_info(name, ring, topic, decoder.first(info.channel))
        else:
            sensor = _by_message(name, ring, topic, decoder)
        found.append((topic, sensor, in_rig))
    return found


def rig_sensors(topics: list[Topic], rig: Rig) -> list[RigSensor | None]:
    """For each depth topic the sensor of a rig that it matches by name."""
    return [_sensor_of(rig, topic) for topic in topics if topic.use is Use.DEPTH]


def unfit_intrinsics(
    found: list[tuple[Topic, RecordedSensor, RigSensor | None]], topics: list[Topic]
) -> list[str]:
    """Warnings about sensors without a rig whose CameraInfo does not fit them."""
    warnings: list[str] = []
    candidates = _Infos(topics)
    unusable = {
        parent(t.name): t
        for t in topics
        if t.use is Use.NOTHING and t.channel.schema_name.endswith("/CameraInfo")
    }
    for topic in [topic for topic, _, in_rig in found if in_rig is None]:
        infos = candidates.of(topic)
        if not infos and (info := unusable.get(parent(topic.name))):
            warnings.append(
                f"{info.name} is not used: {info.why_not}; a field of view of 45 degrees is "
                "assumed."
            )
        if infos and all(info.grid != topic.grid for info in infos):
            warnings.append(
                f"{infos[0].name} is for images of {size_text(_grid(infos[0]))} zones and those of "
                f"{topic.name} are {size_text(_grid(topic))}; a field of view of 45 degrees is "
                "assumed."
            )
    return warnings


class _Infos:
    """Topics of intrinsics by their frames and places in the tree of topics."""

    def __init__(self, topics: list[Topic]) -> None:
        self._by_frame: dict[str, list[Topic]] = {}
        self._beside: dict[str, list[Topic]] = {}
        for info in topics:
            if info.use is Use.CAMERA_INFO:
                self._by_frame.setdefault(info.frame, []).append(info)
                self._beside.setdefault(parent(info.name), []).append(info)

    def of(self, topic: Topic) -> list[Topic]:
        """Candidates for a depth topic: those with its frame first, then those beside it."""
        return [
            *self._by_frame.get(topic.frame, []),
            *self._beside.get(parent(topic.name), []),
        ]


def _grid(topic: Topic) -> Grid:
    if topic.grid is None:
        raise ValueError(f"{topic.name} holds neither images nor intrinsics.")
    return topic.grid


def distances(
    message: Any,  # noqa: ANN401 (a decoded message)
    sensor: RecordedSensor,
    form: RangeFormat = DEPTH_IMAGE,
) -> NDArray[np.float64]:
    """Distances (rows, columns) in metres of a message with ranges, `valid` or not.

    Args:
        message: of the format's type; its size may differ from that of the topic's first message.
        sensor: of the message.
        form: of the message.

    Raises:
        MisfitError: the message has another size or encoding, or too few bytes.
    """
    grid, found = sensor.images or sensor.grid, form.grid(message)
    if found != grid:
        held = found if isinstance(found, str) else f"it is {size_text(found)}"
        raise MisfitError(f"{held}, and not {size_text(grid)} distances")
    return sensor.arrange(form.ranges(message))


def valid(
    values: NDArray[np.float64],
    status: NDArray[np.uint8],
    with_status: NDArray[np.bool_],
    limits: NDArray[np.float64],
) -> NDArray[np.bool_]:
    """Find the distances of several sensors that are readings.

    Args:
        values: (S, R, C) metres.
        status: (S, R, C) ST's target status.
        with_status: (S,) whether a sensor's status is known.
        limits: (S, 2) smallest and largest valid reading of each sensor, metres.

    Returns:
        (S, R, C).
    """
    low, high = limits.T[:, :, None, None]
    good = np.isfinite(values) & (values > 0) & (values >= low) & (values <= high)
    return good & (_IS_VALID[status] | ~with_status[:, None, None])


def status_codes(status: Any, sensor: RecordedSensor) -> NDArray[np.uint8]:  # noqa: ANN401
    """ST's target status (rows, columns) of a status image, in the order of the readings.

    Raises:
        MisfitError: the image is of another size, or has fewer bytes than that says.
    """
    return sensor.arrange(_status_pixels(status, sensor))


def _status_pixels(status: Any, sensor: RecordedSensor) -> NDArray[np.uint8]:  # noqa: ANN401
    grid = sensor.images or sensor.grid
    if (status.height, status.width) != grid:
        raise MisfitError(
            f"its status image is {status.width} x {status.height}, and not {size_text(grid)}"
        )
    return pixels(status, np.dtype(np.uint8))


def _sensor_of(rig: Rig, topic: Topic) -> RigSensor | None:
    """Sensor of a rig whose name is part of the topic or of its frame."""
    texts = [f"_{plain_name(text)}_" for text in (parent(topic.name), topic.frame)]
    fitting = [s for s in rig.sensors if any(f"_{plain_name(s.name)}_" in text for text in texts)]
    return max(fitting, key=lambda s: len(s.name), default=None)


def _by_model(name: str, ring: str, topic: Topic, model: SensorModel) -> RecordedSensor:
    limits = (model.min_range, model.max_range)
    return RecordedSensor(
        name, ring, topic.frame, model.directions, model.arrange, limits, images=topic.grid
    )


def _by_message(name: str, ring: str, topic: Topic, decoder: Decoder) -> RecordedSensor:
    """A sensor with the rays that its first message knows, else with the default model."""
    form = range_format(topic.channel.schema_name)
    if form is None or form.directions is None:
        rows, columns = _grid(topic)
        return _by_model(name, ring, topic, SensorModel(rows=rows, columns=columns))
    rays = form.directions(decoder.first(topic.channel))
    return RecordedSensor(name, ring, topic.frame, rays, lambda values: values, (0.0, np.inf))


def _by_camera_info(name: str, ring: str, topic: Topic, info: Any) -> RecordedSensor:  # noqa: ANN401
    # REP 118: a depth image holds distances along the optical axis, in the order of the optical
    # frame, so that only the camera matrix is needed.
    fx, fy, cx, cy = camera_matrix(info)
    rows, columns = _grid(topic)
    return RecordedSensor(
        name=name,
        ring=ring,
        frame=topic.frame,
        directions=zone_rays(rows, columns, fx=fx, fy=fy, cx=cx, cy=cy),
        arrange=lambda values: values,
        limits=(0.0, np.inf),
    )


@dataclass(frozen=True)
class DepthStream:
    """The images of one sensor.

    Attributes:
        topic: of the depth images.
        sensor: of the images.
        status: topic of the target status beside them, None without.
        status_index: index of the status message of each depth message, -1 where it has none.
        form: of the messages.
    """

    topic: Topic
    sensor: RecordedSensor
    status: Topic | None
    status_index: NDArray[np.int64]
    form: RangeFormat


def depth_stream(
    topic: Topic, sensor: RecordedSensor, topics: list[Topic], decoder: Decoder
) -> DepthStream:
    """Join a sensor's depth images with the status of the same readings, by their stamps."""
    beside = (t for t in topics if t.use is Use.STATUS and t.grid == topic.grid)
    status = next((t for t in beside if parent(t.name) == parent(topic.name)), None)
    stamps = decoder.header_stamps(topic.channel)
    index = np.full(len(stamps), -1, dtype=np.int64)
    if status is not None:
        of_status = decoder.header_stamps(status.channel)
        order = np.argsort(of_status, kind="stable")
        at = np.searchsorted(of_status[order], stamps, side="right") - 1  # of equals the last
        row = order[np.maximum(at, 0)]
        index = np.where((at >= 0) & (of_status[row] == stamps), row, -1)
    form = range_format(topic.channel.schema_name)
    assert form is not None  # or the topic would not be used as ranges
    return DepthStream(topic, sensor, status, index, form)
