"""Writer of recordings: ROS 2 profile, CDR, standard types, so that other tools open them."""

from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from types import MappingProxyType, TracebackType

import numpy as np
from mcap.writer import CompressionType, Writer

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
from recordings.transforms import inverse
from robot_assets import Rig, Robot

_LATCHED = (
    "- durability: transient_local\n  reliability: reliable\n  history: keep_last\n  depth: 1"
)
_STREAMED = "- durability: volatile\n  reliability: reliable\n  history: keep_last\n  depth: 10"


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
        self._stamps: dict[str, list[int]] = {}
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
        base = self._robot.base
        if not self._stamps:
            self._write_constants(stamp)
        self._add("/joint_states", ros.joint_state(stamp, base, frame.joint_positions), stamp)
        self._add("/tf", ros.transforms(stamp, self._moving_poses(frame)), stamp)
        # A depth image holds distances along the optical axis; a sensor may report them radially.
        ranges = frame.ranges * self._rig.model.directions[..., 2]
        for i, name in enumerate(self._names):
            image = ros.depth_image(stamp, _frame_id(name), ranges[i])
            self._add(depth_topic(name), image, stamp)
            if frame.status is not None:
                status = ros.status_image(stamp, _frame_id(name), frame.status[i])
                self._add(f"/tof/{name}/status", status, stamp)
        motion = ros.twist(stamp, base, frame.target_velocity, frame.target_turn_rate)
        self._add("/target/velocity", motion, stamp)
        self._add("/target/pose", ros.pose(stamp, base, frame.T_base_target), stamp)
        truth = PointTruth(
            points=frame.truth.points,
            velocity=frame.truth.velocity,
            object=frame.truth.object,
            sensor=self._index_in_file[frame.truth.sensor],
            zone=frame.truth.zone,
        )
        self._add("/truth/points", ros.points(stamp, base, truth, len(self._names)), stamp)

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

    def _add(self, topic: str, message: object, stamp: int, latched: bool = False) -> None:
        kind = message.__msgtype__  # type: ignore[attr-defined]
        if topic not in self._channels:
            if kind not in self._schemas:
                schema = self._writer.register_schema(kind, "ros2msg", ros.schema_text(kind))
                self._schemas[kind] = schema
            quality = {"offered_qos_profiles": _LATCHED if latched else _STREAMED}
            channel = self._writer.register_channel(topic, "cdr", self._schemas[kind], quality)
            self._channels[topic] = channel
        data = ros.serialise(message)
        self._writer.add_message(self._channels[topic], stamp, data, stamp)
        self._stamps.setdefault(topic, []).append(stamp)


def _frame_id(topic_part: str) -> str:
    return "tof_" + topic_part.replace("/", "_") + "_optical_frame"
