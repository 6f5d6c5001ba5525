"""Writer of recordings: ROS 2 profile, CDR, standard types, so that other tools open them."""

from array import array
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from functools import partial
from pathlib import Path
from types import MappingProxyType, TracebackType
from typing import Any

import numpy as np
from mcap.writer import CompressionType, Writer
from numpy.typing import NDArray

from recordings import ros_messages as ros
from recordings.contents import natural_key
from recordings.draft import Draft
from recordings.errors import RecordingError
from recordings.frame import Frame, PointTruth, Provenance
from recordings.object_meshes import MESHES_TYPE, OBJECT_MESHES, ObjectMesh, pack_meshes
from recordings.object_truth import OBJECT_FRAME, TARGET_FRAME
from recordings.provenance import PROVENANCE_RECORD, provenance_record
from recordings.rig_record import RIG_ATTACHMENT, RIG_TYPE, depth_topic, packed, topic_part
from recordings.stamp_index import MEDIA_TYPE, STAMP_INDEX, pack
from recordings.stamped_message import StampedMessage, stamped
from recordings.transforms import inverse
from recordings.velocity_record import (
    BYTES,
    MANY,
    VELOCITIES,
    VELOCITIES_TYPE,
    VELOCITY_TOPIC,
    pack_velocities,
)
from robot_assets import Rig, Robot

_LATCHED = (
    "- durability: transient_local\n  reliability: reliable\n  history: keep_last\n  depth: 1"
)
_STREAMED = "- durability: volatile\n  reliability: reliable\n  history: keep_last\n  depth: 10"

_Make = Callable[[int], Any]


class RecordingWriter:
    """Writer of frames and their rig into an MCAP file; use it in a `with` statement.

    The file appears under its name once it is complete; of a failed one nothing stays.

    Args:
        path: of the file; an existing file is replaced.
        robot: that carries the sensors.
        rig: its sensors.
        provenance: of the readings.
        meshes: {frame: surface} of moving objects, in frames that the frames' poses place.

    Raises:
        RecordingError: the file cannot be written.
    """

    def __init__(
        self,
        path: Path,
        robot: Robot,
        rig: Rig,
        provenance: Provenance,
        meshes: Mapping[str, ObjectMesh] = MappingProxyType({}),
    ) -> None:
        self._path = path
        self._robot = robot
        self._rig = rig
        self._names = [topic_part(sensor.name) for sensor in rig.sensors]
        order = sorted(range(len(self._names)), key=lambda i: natural_key(self._names[i]))
        self._index_in_file = np.argsort(order)
        self._channels: dict[str, int] = {}
        self._schemas: dict[str, int] = {}
        self._stamps: dict[str, array[int]] = {}
        self._velocities: array[float] = array("d")
        with self._in_words():
            self._draft = Draft(path)
        self._writer = Writer(self._draft.stream, compression=CompressionType.ZSTD)
        try:
            with self._in_words():
                self._writer.start(profile="ros2", library="tofscope")
                self._writer.add_metadata(PROVENANCE_RECORD, provenance_record(provenance))
                self._writer.add_attachment(0, 0, RIG_ATTACHMENT, RIG_TYPE, packed(rig))
                if meshes:
                    content = pack_meshes(meshes)
                    self._writer.add_attachment(0, 0, OBJECT_MESHES, MESHES_TYPE, content)
        except BaseException:
            self._draft.discard()
            raise

    def __enter__(self) -> "RecordingWriter":
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        traceback: TracebackType | None,
    ) -> None:
        try:
            if kind is None:
                with self._in_words():
                    self._writer.add_attachment(0, 0, STAMP_INDEX, MEDIA_TYPE, pack(self._stamps))
                    if len(self._stamps.get(VELOCITY_TOPIC, ())) >= MANY:
                        content = pack_velocities(self._velocities)
                        self._writer.add_attachment(0, 0, VELOCITIES, VELOCITIES_TYPE, content)
                    self._writer.finish()
                    self._draft.complete()
        finally:
            self._draft.discard()

    def write(self, frame: Frame) -> None:
        """Append a frame; stamps must increase.

        Raises:
            RecordingError: the file cannot be written.
        """
        with self._in_words():
            self._write(frame)

    @contextmanager
    def _in_words(self) -> Iterator[None]:
        try:
            yield
        except OSError as error:
            raise RecordingError(f"{self._path} cannot be written: {error.strerror}.") from error

    def _write(self, frame: Frame) -> None:
        stamp = round(frame.stamp * 1e9)
        if not self._stamps:
            self._write_constants(stamp)
        for topic, make in [*self._pose_messages(frame), *self._reading_messages(frame)]:
            self._add(topic, make(stamp), stamp)

    def prepared(self, frame: Frame) -> list[StampedMessage]:
        """Messages of a frame for `write_again`; its stamp is of no matter."""
        makers = [*self._pose_messages(frame), *self._reading_messages(frame)]
        return [stamped(topic, make) for topic, make in makers]

    def prepared_poses(self, frame: Frame) -> list[StampedMessage]:
        """Joints and poses of a frame alone for `write_again`."""
        return [stamped(topic, make) for topic, make in self._pose_messages(frame)]

    def write_again(self, messages: list[StampedMessage], stamp: int) -> None:
        """Append prepared messages with a stamp in nanoseconds; stamps must increase.

        Raises:
            RecordingError: the file cannot be written.
        """
        with self._in_words():
            if not self._stamps:
                self._write_constants(stamp)
            for message in messages:
                self._append(message.topic, message.kind, message.at(stamp), stamp)

    def _pose_messages(self, frame: Frame) -> Iterator[tuple[str, _Make]]:
        """(topic, what makes its message with a stamp) of the joints and the poses."""
        base, moving = self._robot.base, self._moving_poses(frame)
        yield "/joint_states", lambda stamp: ros.joint_state(stamp, base, frame.joint_positions)
        yield "/tf", lambda stamp: ros.transforms(stamp, moving)

    def _reading_messages(self, frame: Frame) -> Iterator[tuple[str, _Make]]:
        """As `_pose_messages`, of the readings and the truth."""
        base = self._robot.base
        # A depth image holds distances along the optical axis; a sensor may report them radially.
        ranges = frame.ranges * self._rig.model.directions[..., 2]
        for i, name in enumerate(self._names):
            yield depth_topic(name), partial(_image, ros.depth_image, name, ranges[i])
            if frame.status is not None:
                status = partial(_image, ros.status_image, name, frame.status[i])
                yield f"/tof/{name}/status", status
        motion = frame.target_velocity, frame.target_turn_rate
        yield VELOCITY_TOPIC, lambda stamp: ros.twist(stamp, base, *motion)
        yield "/target/pose", lambda stamp: ros.pose(stamp, base, frame.T_base_target)
        truth = PointTruth(
            points=frame.truth.points,
            velocity=frame.truth.velocity,
            object=frame.truth.object,
            sensor=self._index_in_file[frame.truth.sensor],
            zone=frame.truth.zone,
        )
        yield "/truth/points", lambda stamp: ros.points(stamp, base, truth, len(self._names))

    def _write_constants(self, stamp: int) -> None:
        robot = self._robot
        poses = robot.link_poses({})
        fixed = [
            (parent, link, inverse(poses[parent]) @ poses[link])
            for link, parent in robot.parents.items()
            if link in robot.fixed_links
        ]
        mounted = [
            (sensor.link, _frame_id(name), sensor.T_link_sensor)
            for name, sensor in zip(self._names, self._rig.sensors, strict=True)
        ]
        self._add("/robot_description", ros.text(robot.text), stamp, latched=True)
        self._add("/tf_static", ros.transforms(stamp, fixed + mounted), stamp, latched=True)
        for name in self._names:
            info = ros.camera_info(stamp, _frame_id(name), self._rig.model)
            self._add(f"/tof/{name}/camera_info", info, stamp, latched=True)

    def _moving_poses(self, frame: Frame) -> list[tuple[str, str, np.ndarray]]:
        poses = self._robot.link_poses(frame.joint_positions)
        moving = [
            (parent, link, inverse(poses[parent]) @ poses[link])
            for link, parent in self._robot.parents.items()
            if link not in self._robot.fixed_links
        ]
        base = self._robot.base
        objects = [
            (base, f"{OBJECT_FRAME}{number}", pose) for number, pose in frame.object_poses.items()
        ]
        return [*moving, (base, TARGET_FRAME, frame.T_base_target), *objects]

    def _add(self, topic: str, message: Any, stamp: int, latched: bool = False) -> None:  # noqa: ANN401
        self._append(topic, message.__msgtype__, ros.serialise(message), stamp, latched)

    def _append(
        self, topic: str, kind: str, data: bytes, stamp: int, latched: bool = False
    ) -> None:
        if topic not in self._channels:
            if kind not in self._schemas:
                schema = self._writer.register_schema(kind, "ros2msg", ros.schema_text(kind))
                self._schemas[kind] = schema
            quality = {"offered_qos_profiles": _LATCHED if latched else _STREAMED}
            channel = self._writer.register_channel(topic, "cdr", self._schemas[kind], quality)
            self._channels[topic] = channel
        self._writer.add_message(self._channels[topic], stamp, data, stamp)
        self._stamps.setdefault(topic, array("q")).append(stamp)
        if topic == VELOCITY_TOPIC:
            self._velocities.frombytes(data[-BYTES:])


def _image(make: Callable[..., Any], name: str, values: NDArray[Any], stamp: int) -> Any:  # noqa: ANN401
    return make(stamp, _frame_id(name), values)


def _frame_id(topic_part: str) -> str:
    return "tof_" + topic_part.replace("/", "_") + "_optical_frame"
