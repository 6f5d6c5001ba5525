"""A minute of a recording with joints and /tf at 1 kHz, quickly made."""

import io
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np
from mcap.reader import make_reader
from mcap.writer import Writer

from recordings.stamp_index import STAMP_INDEX
from recordings.writer import RecordingWriter
from tests.recordings.foreign import at
from tests.recordings.test_writer import POSE, PROVENANCE, RIG, ROBOT, frames

SECONDS, RATE, POSE_RATE = 60, 15, 1000
_POSES = 300
"""Postures of the robot, which it takes one after the other, again and again."""

Message = tuple[str, str, bytes, bytes, int]
"""Topic, type, schema, content, log time."""


def write_long(path: Path) -> Path:
    """60 s of 24 sensors at 15 Hz; the robot and the target move all the time, at 1 kHz."""
    made = frames(4)
    with RecordingWriter(path, ROBOT, RIG, PROVENANCE) as writer:
        readings = [writer.prepared(replace(frame, stamp=0.0)) for frame in made]
        poses = []
        for n in range(_POSES):
            swing = np.sin(2 * np.pi * n / _POSES)
            posture = POSE | {joint: POSE[joint] + 0.05 * swing for joint in ROBOT.joint_names[:6]}
            target = at(y=0.7 + 0.1 * swing, turn=0.2 * swing)
            frame = replace(made[0], joint_positions=posture, T_base_target=target)
            poses.append(writer.prepared_poses(frame))
        period = round(1e9 / RATE)
        times = [(k * period, readings[k % 4], 0) for k in range(SECONDS * RATE)]
        step = 10**9 // POSE_RATE
        times += [(n * step, poses[n % _POSES], 1) for n in range(SECONDS * POSE_RATE)]
        for time, messages, is_pose in sorted(times, key=lambda item: (item[0], item[2])):
            # The poses of a frame are those of the robot at its stamp, too.
            written = messages if is_pose else messages[2:]
            writer.write_again(written, 10**9 + time)
    return path


def without_index(path: Path, copy: Path) -> Path:
    """Copy a recording without its index of stamps."""
    name = STAMP_INDEX.encode()
    copy.write_bytes(path.read_bytes().replace(name, b"x" * len(name)))
    return copy


def rewritten(
    path: Path, copy: Path, order: Callable[[list[Message]], list[Message]], chunk: int = 200_000
) -> Path:
    """Copy a recording as another writer writes it: messages alone, in another order or time."""
    messages: list[Message] = []
    with path.open("rb") as stream:
        for schema, channel, message in make_reader(stream).iter_messages():
            assert schema is not None
            kind = channel.topic, schema.name, schema.data
            messages.append((*kind, message.data, message.log_time))
    buffer = io.BytesIO()
    writer = Writer(buffer, chunk_size=chunk)
    writer.start(profile="ros2")
    channels: dict[str, int] = {}
    for topic, kind, text, data, time in order(messages):
        if topic not in channels:
            schema = writer.register_schema(kind, "ros2msg", text)
            channels[topic] = writer.register_channel(topic, "cdr", schema)
        writer.add_message(channels[topic], time, data, time)
    writer.finish()
    copy.write_bytes(buffer.getvalue())
    return copy
