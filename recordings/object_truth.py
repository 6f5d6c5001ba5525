"""Finding the truth of a recording, and transforming it into the fixed frame."""

import numpy as np
from numpy.typing import NDArray

from recordings.contents import Topic, Use, named_truth
from recordings.decoding import Decoder
from recordings.errors import few
from recordings.frame_table import FrameTable
from recordings.layouts import all_samples
from recordings.message_kinds import POSE, TWIST
from recordings.nearby import Column, FramePlaces
from recordings.point_truth import PointTruths
from recordings.tracks import Stamps, pose_track, vector_track
from recordings.transforms import TransformTree
from recordings.truth import ObjectTruth, RigidTruth, TurningTruth, TwistTruth
from recordings.truth_nearby import TURNING, PosesOfTopic, TwistNearby

TARGET_FRAME = "target"
"""Frame of the moving object in /tf of our own files."""
OBJECT_FRAME = "object_"
"""Prefix of an object's frame in /tf; the object's number in the truth of points follows."""
_DIGITS = 9  # of an object's number


def object_truth(
    topics: list[Topic],
    decoder: Decoder,
    stamps: Stamps,
    tree: TransformTree,
    fixed_frame: str,
    truth_frame: str | None,
    places: FramePlaces | None = None,
) -> tuple[ObjectTruth | None, list[str]]:
    """Find the motion of the moving object.

    Args:
        topics: of the file.
        decoder: of the file.
        stamps: (K,) nanoseconds of the frames.
        tree: poses of /tf.
        fixed_frame: of the result.
        truth_frame: the frame whose motion is the truth; None for the recorded twist or pose.
        places: of the frames of a long recording, around which a topic with many messages is read.

    Returns:
        The truth, None where there is none, and warnings about topics that could not be used.
    """
    if truth_frame is not None:
        if truth_frame not in tree.frames or not tree.connected(fixed_frame, truth_frame):
            listed = few(sorted(tree.frames)) or "no frames"
            return None, [
                f"The truth frame {truth_frame} has no pose in {fixed_frame}, so there is no "
                f"truth; /tf has {listed}."
            ]
        return RigidTruth(tree.poses(fixed_frame, truth_frame, len(stamps)), stamps), []
    warnings: list[str] = []
    for use, read in ((Use.VELOCITY, _by_twist), (Use.POSE, _by_pose)):
        for topic in topics:
            if topic.use is use:
                truth, more = read(topic, decoder, stamps, tree, fixed_frame, places)
                warnings += more
                if isinstance(truth, TwistTruth) and truth.rotates:
                    truth = _with_pose(truth, topics, decoder, stamps, tree, fixed_frame, places)
                if truth is not None:
                    if not named_truth(topic.name):
                        what = use.removeprefix("truth: ")
                        warnings.append(
                            f"{topic.name} is taken as the truth, being the only {what} there is."
                        )
                    return truth, warnings
    return None, warnings + [
        f"{topic.name} is not used as the truth: {topic.why_not}."
        for topic in topics
        if topic.candidate
    ]


def point_truths(
    topics: list[Topic],
    decoder: Decoder,
    table: FrameTable,
    tree: TransformTree,
    fixed_frame: str,
) -> tuple[PointTruths | None, list[str]]:
    """Find the truth of every point; None, with a warning, where it is in another frame.

    The frame `object_3` of /tf is the pose of object 3 in that truth.
    """
    topic = next((topic for topic in topics if topic.use is Use.POINTS), None)
    if topic is None:
        return None, []
    if topic.frame not in ("", fixed_frame):
        return None, [
            f"The truth of points is given in {topic.frame} and not in {fixed_frame}; "
            f"it is not used."
        ]
    numbers = {f.removeprefix(OBJECT_FRAME): f for f in tree.frames if f.startswith(OBJECT_FRAME)}
    frames = {
        int(number): frame
        for number, frame in numbers.items()
        if number.isdecimal() and len(number) <= _DIGITS and tree.connected(fixed_frame, frame)
    }

    def poses(number: int) -> NDArray[np.float64] | Column | None:
        frame = frames.get(number)
        return None if frame is None else tree.poses(fixed_frame, frame, len(table.stamps))

    return PointTruths(topic, decoder, table.stamps, 0.5 * table.period, poses), []


def _with_pose(
    twist: TwistTruth,
    topics: list[Topic],
    decoder: Decoder,
    stamps: Stamps,
    tree: TransformTree,
    fixed_frame: str,
    places: FramePlaces | None,
) -> ObjectTruth:
    """Truth of a rotating object: its twist, with its pose where that is recorded."""
    for topic in topics:
        if topic.use is Use.POSE:
            rigid, _ = _by_pose(topic, decoder, stamps, tree, fixed_frame, places)
            if isinstance(rigid, RigidTruth):
                return TurningTruth(twist, rigid)
    return twist


def _by_twist(
    topic: Topic,
    decoder: Decoder,
    stamps: Stamps,
    tree: TransformTree,
    fixed_frame: str,
    places: FramePlaces | None,
) -> tuple[ObjectTruth | None, list[str]]:
    rotation, why_not, warnings = _into_fixed(topic, tree, fixed_frame, len(stamps))
    if rotation is None:
        return None, why_not
    if places and places.is_long(topic.channel):
        nearby = TwistNearby(topic.channel, places, rotation)
        if not nearby.usable:
            return None, [f"{topic.name} has no finite velocity."]
        if (samples := nearby.all_samples()) is None:
            # Whether it ever turns is not known, and looked at for every pair.
            return TwistTruth(nearby, stamps, rotates=True), warnings
    else:
        samples = all_samples(decoder, topic.channel, TWIST, lambda _: 0)
    rotates = bool((np.abs(samples.values[:, 3:]) > TURNING).any())
    track = vector_track(samples.stamps, samples.values[:, :3])
    if track is None:
        return None, [f"{topic.name} has no finite velocity."]
    return TwistTruth(track.rotated(rotation), stamps, rotates), warnings


def _into_fixed(
    topic: Topic, tree: TransformTree, fixed_frame: str, frames: int
) -> tuple[NDArray[np.float64] | None, list[str], list[str]]:
    """Rotation (3, 3) of a topic's velocities into the fixed frame.

    Returns:
        The rotation, None with the reason where there is none; the reason; and warnings.
    """
    if topic.frame in ("", fixed_frame):
        return np.eye(3), [], []
    given = f"The velocity on {topic.name} is given in {topic.frame}, which"
    if not tree.connected(fixed_frame, topic.frame):
        said = f"{given} nothing places in {fixed_frame}; it is taken to be in {fixed_frame}."
        return np.eye(3), [], [said]
    if tree.moves(fixed_frame, topic.frame):
        return None, [f"{given} moves in {fixed_frame}; it is not used as the truth."], []
    known = np.flatnonzero(tree.known(fixed_frame, topic.frame, frames))
    if len(known) == 0:
        return None, [f"The pose of {topic.frame} is not known at any frame."], []
    return tree.transform(fixed_frame, topic.frame, int(known[0]))[:3, :3], [], []


def _by_pose(
    topic: Topic,
    decoder: Decoder,
    stamps: Stamps,
    tree: TransformTree,
    fixed_frame: str,
    places: FramePlaces | None,
) -> tuple[ObjectTruth | None, list[str]]:
    if topic.frame not in ("", fixed_frame) and not tree.connected(fixed_frame, topic.frame):
        return None, [
            f"The pose on {topic.name} is given in {topic.frame}, which nothing places in "
            f"{fixed_frame}; it is not used as the truth."
        ]
    if places and places.is_long(topic.channel):
        return _by_pose_nearby(topic, places, tree, fixed_frame)
    samples = all_samples(decoder, topic.channel, POSE, lambda _: 0)
    track = pose_track(samples.stamps, samples.values[:, :3], samples.values[:, 3:])
    if track is None:
        return None, [f"{topic.name} has no usable pose."]
    poses = track.at(stamps)
    if topic.frame not in ("", fixed_frame):
        poses = tree.over(fixed_frame, topic.frame, len(stamps)) @ poses
    return RigidTruth(poses, stamps), []


def _by_pose_nearby(
    topic: Topic, places: FramePlaces, tree: TransformTree, fixed_frame: str
) -> tuple[ObjectTruth | None, list[str]]:
    """As `_by_pose`, of a topic of a long recording."""
    column, stamps = PosesOfTopic(topic.channel, places).column(), places.stamps
    if column is None:
        return None, [f"{topic.name} has no usable pose."]
    if topic.frame in ("", fixed_frame):
        return RigidTruth(column, stamps), []
    given = tree.poses(fixed_frame, topic.frame, len(stamps))
    known = column.known & tree.known(fixed_frame, topic.frame, len(stamps))
    return RigidTruth(Column(lambda k: given[k] @ column[k], known), stamps), []
