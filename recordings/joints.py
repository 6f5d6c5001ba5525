"""Joint positions at the frames of a recording."""

from collections.abc import Iterable, Mapping

import numpy as np
from numpy.typing import NDArray

from recordings.contents import Topic, Use
from recordings.decoding import Decoder
from recordings.errors import few
from recordings.joints_nearby import JointsNearby
from recordings.nearby import Column, FramePlaces, known_at
from recordings.tracks import Stamps, vector_track
from robot_assets import JointMatch, Robot

_FIRST_MESSAGES = 50  # enough to see both kinds in a stream that mixes arm and gripper
_NOT_MEASURED = ("desired", "command", "target", "goal")

Positions = NDArray[np.float64] | Column
"""Positions (K,) of a joint at the frames, rad or m."""


def joint_names(topics: list[Topic], decoder: Decoder) -> list[str]:
    """Names of all joints in a file, from the first messages of each topic."""
    names: list[str] = []
    for topic in _joint_topics(topics):
        for message_names in _first_names(topic, decoder):
            names += message_names
    return list(dict.fromkeys(names))


def joint_positions(
    topics: list[Topic],
    decoder: Decoder,
    match: JointMatch,
    stamps: Stamps,
    places: FramePlaces | None = None,
) -> tuple[dict[str, Positions], list[str]]:
    """Read the positions of a robot's joints at given stamps.

    Those of a topic with many messages in a long recording are read where they are asked for; see
    `JointsNearby`.

    Of several topics with the same joint, measured positions are preferred to desired ones, then
    the topic with the most joints.

    Args:
        topics: of the file; those used as joint positions are read.
        decoder: of the file.
        match: of recorded names to joints.
        stamps: (K,) nanoseconds.
        places: of the frames of a long recording, whose stamps these are.

    Returns:
        {joint: (K,) rad or m, NaN where the recording does not cover the stamp}, and warnings
        about topics with the same joints.
    """
    found: dict[str, dict[str, Positions]] = {}
    for topic in _joint_topics(topics):
        if places and places.is_long(topic.channel):
            found[topic.name] = dict(JointsNearby(topic, places, match).columns())
        else:
            found[topic.name] = dict(_of_topic(topic, decoder, match, stamps))
    positions: dict[str, Positions] = {}
    unused: list[str] = []
    for name in sorted(found, key=lambda name: (_is_not_measured(name), -len(found[name]))):
        if set(found[name]) & set(positions):
            unused.append(name)
        positions = found[name] | positions
    warnings = [
        f"{name} has joints that another topic has too, and is not used for them."
        for name in unused
    ]
    return positions, warnings


def matched(robot: Robot, names: list[str]) -> tuple[JointMatch, list[str]]:
    """Match recorded joint names to a robot; returns the match and warnings."""
    match = robot.match_joints(names)
    warnings: list[str] = []
    if match.rivals:
        each = " and ".join(f"that of {name}" for name in match.rivals)
        used = [f"that of {name} is used" for name in match.rivals if name in match.joints]
        what = used[0] if used else "none is used; give a URDF with the joint names of one"
        warnings.append(
            f"The recorded joints fit more than one robot like {robot.name}, {each}; {what}."
        )
    elif match.ambiguous:
        warnings.append(
            f"Several recorded joints fit {few(match.ambiguous)} of {robot.name}; "
            "none of them is used."
        )
    return match, warnings


def beyond_limits(robot: Robot, positions: Mapping[str, Positions]) -> list[str]:
    """Warnings about joints beyond their limits, at each joint's position furthest from its median.

    Of joints that are read where they are asked for, the first and the last chunks are looked at.

    Args:
        robot: the robot.
        positions: {joint: (K,)} as recorded.
    """
    looked_at = {j: v.ends if isinstance(v, Column) else v for j, v in positions.items()}
    extremes = {
        joint: float(values[np.nanargmax(np.abs(values - np.nanmedian(values)))])
        for joint, values in looked_at.items()
        if np.isfinite(values).any()
    }
    return robot.outside_limits(extremes)


def unknown_joints(
    robot: Robot, positions: Mapping[str, Positions], placed: Iterable[str]
) -> list[str]:
    """Warnings about joints without a position, and their effect on the robot.

    Args:
        robot: the robot.
        positions: {joint: (K,)} as recorded.
        placed: links with a pose in /tf.
    """
    at_frames = {joint: known_at(values) for joint, values in positions.items()}
    known = {joint for joint, frames in at_frames.items() if frames.any()}
    if not known:
        return []
    warnings: list[str] = []
    if missing := [j for j in robot.joint_names if j not in known]:
        found = robot.links_placed_by(known).union(placed)
        lost = [link for link in robot.links if link not in found]
        what = f"{few(lost)} cannot be placed" if lost else "it is taken to be at rest"
        warnings.append(f"The recording has no position of {few(missing)}; {what}.")
    frames = int(max((~at_frames[joint]).sum() for joint in known))
    if frames:
        warnings.append(
            f"Joint positions are not known at {frames} frames; the robot is not placed there, "
            "and its body not removed."
        )
    return warnings


def _joint_topics(topics: list[Topic]) -> list[Topic]:
    return [topic for topic in topics if topic.use is Use.JOINTS]


def _is_not_measured(topic: str) -> bool:
    return any(word in topic.lower() for word in _NOT_MEASURED)


def _first_names(topic: Topic, decoder: Decoder) -> set[tuple[str, ...]]:
    messages = decoder.first_messages(topic.channel, _FIRST_MESSAGES)
    return {tuple(str(name) for name in message.name) for message in messages}


def _of_topic(
    topic: Topic, decoder: Decoder, match: JointMatch, stamps: Stamps
) -> dict[str, NDArray[np.float64]]:
    message_stamps = decoder.header_stamps(topic.channel)
    wanted = np.arange(len(message_stamps))
    if len(_first_names(topic, decoder)) == 1:
        # Joint streams run at up to 1 kHz: only the messages next to a frame are decoded. Not where
        # messages hold different joints, since the neighbours may lack the needed one.
        order = np.argsort(message_stamps, kind="stable")
        after = np.searchsorted(message_stamps[order], stamps)
        around = np.clip(np.concatenate([after - 1, after]), 0, len(order) - 1)
        wanted = order[np.unique(around)]
    samples: dict[str, list[tuple[int, float]]] = {}
    for index in wanted.tolist():
        if (message := decoder.fitting(topic.channel, index)) is None:
            continue
        for name, value in zip(message.name, message.position, strict=False):
            if joint := match.joints.get(str(name)):
                samples.setdefault(joint, []).append((int(message_stamps[index]), float(value)))
    positions: dict[str, NDArray[np.float64]] = {}
    for joint, pairs in samples.items():
        track = vector_track(
            np.array([stamp for stamp, _ in pairs], dtype=np.int64),
            np.array([[value] for _, value in pairs]),
        )
        if track is not None:
            positions[joint] = track.at(stamps)[:, 0]
    return positions
