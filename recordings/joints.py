"""Joint positions at the frames of a recording."""

import numpy as np
from numpy.typing import NDArray

from recordings.contents import Topic, Use
from recordings.decoding import Decoder
from recordings.mcap_file import McapFile
from recordings.tracks import Stamps, vector_track
from robot_assets import JointMatch, Robot


def joint_names(topics: list[Topic], decoder: Decoder) -> list[str]:
    """The names of all joints in a file, by the first message of each topic."""
    names: list[str] = []
    for topic in topics:
        if topic.use is Use.JOINTS:
            names += [str(name) for name in decoder.decode(topic.channel, 0).name]
    return list(dict.fromkeys(names))


def joint_positions(
    topics: list[Topic], file: McapFile, decoder: Decoder, match: JointMatch, stamps: Stamps
) -> dict[str, NDArray[np.float64]]:
    """Read the positions of a robot's joints at given stamps.

    Joint streams run at up to 1 kHz; only the messages next to a frame are decoded.

    Args:
        topics: of the file; those used as joint positions are read.
        file: the file.
        decoder: of the same file.
        match: which recorded name is which joint.
        stamps: (K,) nanoseconds.

    Returns:
        {joint: (K,) rad or m, NaN where the recording does not cover the stamp}.
    """
    positions: dict[str, NDArray[np.float64]] = {}
    for topic in [topic for topic in topics if topic.use is Use.JOINTS]:
        message_stamps = decoder.header_stamps(topic.channel)
        order = np.argsort(message_stamps, kind="stable")
        after = np.searchsorted(message_stamps[order], stamps)
        around = np.clip(np.concatenate([after - 1, after]), 0, len(order) - 1)
        samples: dict[str, list[tuple[int, float]]] = {}
        for index in order[np.unique(around)].tolist():
            message = decoder.decode(topic.channel, index)
            for name, value in zip(message.name, message.position, strict=False):
                if joint := match.joints.get(str(name)):
                    samples.setdefault(joint, []).append((int(message_stamps[index]), float(value)))
        for joint, pairs in samples.items():
            track = vector_track(
                np.array([stamp for stamp, _ in pairs], dtype=np.int64),
                np.array([[value] for _, value in pairs]),
            )
            if track is not None:
                positions[joint] = track.at(stamps)[:, 0]
    return positions


def matched(robot: Robot, names: list[str]) -> tuple[JointMatch, list[str]]:
    """Match recorded joint names to a robot, with a sentence for whatever does not fit."""
    match = robot.match_joints(names)
    warnings: list[str] = []
    if match.ambiguous:
        warnings.append(
            f"Several recorded joints fit {', '.join(match.ambiguous)} of {robot.name}; "
            "none of them is used."
        )
    if match.missing and match.joints:
        warnings.append(
            f"The recording has no position of {', '.join(match.missing)}; "
            f"{robot.name} is drawn with it at rest."
        )
    return match, warnings
