"""Finding the truth of a recording, and transforming it into the fixed frame."""

import numpy as np
from numpy.typing import NDArray

from recordings.contents import Topic, Use, named_truth
from recordings.decoding import Decoder, stamp_of
from recordings.errors import few
from recordings.frame_table import FrameTable
from recordings.point_truth import PointTruths
from recordings.tracks import Stamps, pose_track, vector_track
from recordings.transforms import TransformTree
from recordings.truth import ObjectTruth, RigidTruth, TurningTruth, TwistTruth

TARGET_FRAME = "target"
"""Frame of the moving object in /tf of our own files."""
OBJECT_FRAME = "object_"
"""Prefix of an object's frame in /tf; the object's number in the truth of points follows."""
_DIGITS = 9  # of an object's number
_TURNING = 1e-3  # rad/s


def object_truth(
    topics: list[Topic],
    decoder: Decoder,
    stamps: Stamps,
    tree: TransformTree,
    fixed_frame: str,
    truth_frame: str | None,
) -> tuple[ObjectTruth | None, list[str]]:
    """Find the motion of the moving object.

    Args:
        topics: of the file.
        decoder: of the file.
        stamps: (K,) nanoseconds of the frames.
        tree: poses of /tf.
        fixed_frame: of the result.
        truth_frame: the frame whose motion is the truth; None for the recorded twist or pose.

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
        return RigidTruth(tree.over(fixed_frame, truth_frame, len(stamps)), stamps), []
    warnings: list[str] = []
    for use, read in ((Use.VELOCITY, _by_twist), (Use.POSE, _by_pose)):
        for topic in topics:
            if topic.use is use:
                truth, more = read(topic, decoder, stamps, tree, fixed_frame)
                warnings += more
                if isinstance(truth, TwistTruth) and truth.rotates:
                    truth = _with_pose(truth, topics, decoder, stamps, tree, fixed_frame)
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

    def poses(number: int) -> NDArray[np.float64] | None:
        frame = frames.get(number)
        return None if frame is None else tree.over(fixed_frame, frame, len(table.stamps))

    return PointTruths(topic, decoder, table.stamps, 0.5 * table.period, poses), []


def _with_pose(
    twist: TwistTruth,
    topics: list[Topic],
    decoder: Decoder,
    stamps: Stamps,
    tree: TransformTree,
    fixed_frame: str,
) -> ObjectTruth:
    """Truth of a rotating object: its twist, with its pose where that is recorded."""
    for topic in topics:
        if topic.use is Use.POSE:
            rigid, _ = _by_pose(topic, decoder, stamps, tree, fixed_frame)
            if isinstance(rigid, RigidTruth):
                return TurningTruth(twist, rigid)
    return twist


def _by_twist(
    topic: Topic,
    decoder: Decoder,
    stamps: Stamps,
    tree: TransformTree,
    fixed_frame: str,
) -> tuple[ObjectTruth | None, list[str]]:
    times: list[int] = []
    values: list[tuple[float, float, float]] = []
    rotates = False
    for message in decoder.messages(topic.channel):
        linear, angular = message.twist.linear, message.twist.angular
        times.append(stamp_of(message))
        values.append((linear.x, linear.y, linear.z))
        rotates |= max(abs(angular.x), abs(angular.y), abs(angular.z)) > _TURNING
    velocity = np.array(values)
    warnings: list[str] = []
    if topic.frame not in ("", fixed_frame):
        if not tree.connected(fixed_frame, topic.frame):
            warnings.append(
                f"The velocity on {topic.name} is given in {topic.frame}, which nothing places in "
                f"{fixed_frame}; it is taken to be in {fixed_frame}."
            )
        elif tree.moves(fixed_frame, topic.frame):
            return None, [
                f"The velocity on {topic.name} is given in {topic.frame}, which moves in "
                f"{fixed_frame}; it is not used as the truth."
            ]
        else:
            poses = tree.over(fixed_frame, topic.frame, len(stamps))
            known = poses[np.isfinite(poses).all(axis=(1, 2))]
            if len(known) == 0:
                return None, [f"The pose of {topic.frame} is not known at any frame."]
            velocity = velocity @ known[0, :3, :3].T
    track = vector_track(np.array(times, dtype=np.int64), velocity)
    if track is None:
        return None, [f"{topic.name} has no finite velocity."]
    return TwistTruth(track, stamps, rotates), warnings


def _by_pose(
    topic: Topic,
    decoder: Decoder,
    stamps: Stamps,
    tree: TransformTree,
    fixed_frame: str,
) -> tuple[ObjectTruth | None, list[str]]:
    times: list[int] = []
    positions: list[tuple[float, ...]] = []
    quaternions: list[tuple[float, ...]] = []
    for message in decoder.messages(topic.channel):
        p, q = message.pose.position, message.pose.orientation
        times.append(stamp_of(message))
        positions.append((p.x, p.y, p.z))
        quaternions.append((q.x, q.y, q.z, q.w))
    track = pose_track(np.array(times, dtype=np.int64), np.array(positions), np.array(quaternions))
    if track is None:
        return None, [f"{topic.name} has no usable pose."]
    poses = track.at(stamps)
    if topic.frame not in ("", fixed_frame):
        if not tree.connected(fixed_frame, topic.frame):
            return None, [
                f"The pose on {topic.name} is given in {topic.frame}, which nothing places in "
                f"{fixed_frame}; it is not used as the truth."
            ]
        poses = tree.over(fixed_frame, topic.frame, len(stamps)) @ poses
    return RigidTruth(poses, stamps), []
