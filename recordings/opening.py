"""Opening a recording: what each topic is, where the sensors are, what the truth is."""

from dataclasses import replace
from pathlib import Path

import numpy as np

from recordings.contents import Topic, Use, natural_key, topics_of
from recordings.decoding import Decoder
from recordings.errors import BrokenFileError, RecordingError, few
from recordings.frame_table import FrameTable, frame_table
from recordings.grids import SIZES
from recordings.joints import joint_names, joint_positions, matched, unknown_joints
from recordings.mcap_file import McapFile
from recordings.object_truth import object_truth, point_truths
from recordings.provenance import provenance_of
from recordings.recording import Parts, Recording
from recordings.rig_record import rig_of
from recordings.robot_poses import RobotPoses
from recordings.sensor_poses import SensorPoses
from recordings.sensors import (
    RecordedSensor,
    depth_stream,
    recorded_sensors,
    rig_sensors,
    unfit_intrinsics,
)
from recordings.stamp_index import STAMP_INDEX
from recordings.transforms import TransformTree, read_transforms
from robot_assets import Rig, Robot, RobotError, Sensor, load_rig, load_robot

_COMPLETE = 0.9  # share of the sensors in a frame, below which something is wrong


def open_recording(
    path: str | Path,
    fixed_frame: str | None = None,
    truth_frame: str | None = None,
    rig: Rig | None = None,
    robot: Robot | None = None,
) -> Recording:
    """Open a recording.

    Args:
        path: an MCAP file.
        fixed_frame: in which clouds and truth are; default: the root of the tree of /tf, or the
            robot's base.
        truth_frame: a frame whose rigid motion is the truth; default: the recorded twist or pose.
        rig: sensors by name, intrinsics included, for recordings that do not place their own;
            default: the paper's rig where the joints are a Panda's.
        robot: default: the recording's description, or a Panda where the joints are a Panda's.

    Returns:
        The recording; close it, or use it in a `with` statement.

    Raises:
        RecordingError: the file cannot be read, or holds nothing to estimate from.
    """
    try:
        return _opened(McapFile(Path(path)), fixed_frame, truth_frame, rig, robot)
    except BrokenFileError:
        # What is not broken is worth having.
        return _opened(McapFile(Path(path), salvage=True), fixed_frame, truth_frame, rig, robot)


def _opened(
    file: McapFile,
    fixed_frame: str | None,
    truth_frame: str | None,
    rig: Rig | None,
    robot: Robot | None,
) -> Recording:
    try:
        return _open(file, fixed_frame, truth_frame, rig, robot)
    except BaseException:
        file.close()
        raise


def _open(
    file: McapFile,
    fixed_frame: str | None,
    truth_frame: str | None,
    rig: Rig | None,
    robot: Robot | None,
) -> Recording:
    decoder = Decoder(file)
    topics = topics_of(file, decoder)
    provenance = provenance_of(file)
    own_rig, about_rig = rig_of(file) if provenance is not None else (None, [])
    if rig is not None and provenance is not None:
        # What we write are depth images as REP 118 has them, however the rig's driver delivers.
        rig = replace(rig, model=rig.model.of_depth_images())
    found = recorded_sensors(topics, decoder, rig, own_rig)
    if not found:
        raise RecordingError(_nothing_to_estimate_from(file, topics))
    if rig is not None:
        _check_rig(file, rig, found)
    if STAMP_INDEX not in file.attachments:
        decoder.read_stamps(t.channel for t in topics if t.use in (Use.DEPTH, Use.STATUS))
    streams = [depth_stream(topic, sensor, topics, decoder) for topic, sensor, _ in found]
    table = frame_table([decoder.header_stamps(topic.channel) for topic, _, _ in found])
    tree, warnings = read_transforms(topics, decoder, table.stamps)
    warnings += about_rig + unfit_intrinsics(found, topics) + _about_file(file, table, len(found))

    names = joint_names(topics, file, decoder)
    if robot is None:
        robot, said = _robot(topics, decoder, names)
        warnings += said
    if robot is not None and (missing := robot.missing_meshes):
        count = "One mesh" if len(missing) == 1 else f"{len(missing)} meshes"
        warnings.append(
            f"{count} of {robot.name} not on this machine, such as {missing[0]}; what they show "
            f"is neither drawn nor removed from the clouds."
        )
    if rig is not None and robot is not None:
        rig.check_links(robot.links, robot.name)
    by_rig: list[Sensor | None] = [in_rig for _, _, in_rig in found]
    if rig is None and robot is not None and set(load_robot().links) <= set(robot.links):
        by_rig = rig_sensors(topics, own_rig or load_rig())

    frames = [topic.frame for topic, _, _ in found]
    fixed = _fixed_frame(fixed_frame, file, tree, frames, robot)
    robot_poses = None
    if robot is not None:
        match, said = matched(robot, names)
        positions, doubled = joint_positions(topics, file, decoder, match, table.stamps)
        warnings += said + doubled + _limits(robot, positions)
        warnings += unknown_joints(robot, positions, tree.frames)
        robot_poses = RobotPoses(robot, positions, tree, fixed)
    poses = SensorPoses(frames, tree, fixed, by_rig, robot_poses, len(table.stamps))
    warnings += _unplaced_sensors(file, found, tree, fixed, by_rig, robot, rig)

    truth, said = object_truth(topics, decoder, table.stamps, tree, fixed, truth_frame)
    warnings += said
    points, said = point_truths(topics, decoder, table, tree, fixed)
    warnings += said
    return Recording(
        Parts(
            file=file,
            decoder=decoder,
            frames=table,
            streams=streams,
            sensor_poses=poses,
            robot=robot_poses,
            truth=truth,
            point_truths=points,
            fixed_frame=fixed,
            truth_frame=truth_frame,
            provenance=provenance,
            rig=own_rig,
            warnings=tuple(warnings),
        )
    )


def _about_file(file: McapFile, table: FrameTable, sensors: int) -> list[str]:
    """Sentences about what is wrong with the file as a whole."""
    warnings: list[str] = []
    if file.cut_short:
        warnings.append("The file is cut short; what it holds up to there is used.")
    if file.broken_chunks:
        warnings.append(f"Broken pieces of the file, {file.broken_chunks} of them, are left out.")
    if table.completeness < _COMPLETE:
        warnings.append(
            f"A frame holds {table.completeness * sensors:.1f} of the {sensors} sensors on "
            f"average; their readings are not taken at the same time, or many are lost."
        )
    return warnings


def _nothing_to_estimate_from(file: McapFile, topics: list[Topic]) -> str:
    shown = [f"{t.name} ({t.channel.schema_name or t.channel.encoding})" for t in topics[:6]]
    more = f" and {len(topics) - 6} more" if len(topics) > 6 else ""
    held = f"it holds {', '.join(shown)}{more}" if topics else "it holds no topics"
    return (
        f"{file.path} has no depth images of {SIZES}, so there is nothing to estimate from; {held}."
    )


def _robot(
    topics: list[Topic], decoder: Decoder, names: list[str]
) -> tuple[Robot | None, list[str]]:
    described = next((topic for topic in topics if topic.use is Use.ROBOT), None)
    if described is not None:
        try:
            robot = load_robot(decoder.decode(described.channel, 0).data)
        except RobotError as error:
            return None, [str(error)]
        return robot, []
    panda = load_robot()
    arm = [joint for joint in panda.joint_names if "finger" not in joint]
    fits = set(arm) <= set(panda.match_joints(names).joints.values())
    return (panda, []) if fits else (None, [])


def _limits(robot: Robot, positions: dict[str, np.ndarray]) -> list[str]:
    """Sentences about joints beyond their limits, at the frame where each is furthest out."""
    extremes = {
        joint: float(values[np.nanargmax(np.abs(values - np.nanmedian(values)))])
        for joint, values in positions.items()
        if np.isfinite(values).any()
    }
    return robot.outside_limits(extremes)


def _fixed_frame(
    asked: str | None, file: McapFile, tree: TransformTree, frames: list[str], robot: Robot | None
) -> str:
    known = tree.frames | set(frames) | (set(robot.links) if robot else set())
    if asked is not None:
        if asked not in known:
            listed = [*sorted(known - set(frames)), *sorted(frames, key=natural_key)]
            raise RecordingError(f"{file.path} has no frame {asked}; it has {few(listed)}.")
        return asked
    in_tree = [frame for frame in frames if frame in tree.frames]
    if in_tree:
        roots = [tree.root_of(frame) for frame in in_tree]
        return max(dict.fromkeys(roots), key=roots.count)
    if robot:
        return robot.base
    if len(frames) > 1:
        raise RecordingError(
            f"{file.path}: nothing places its {len(frames)} sensors relative to each other; it "
            f"needs /tf, or joints and a rig."
        )
    return frames[0]


def _unplaced_sensors(
    file: McapFile,
    found: list[tuple[Topic, RecordedSensor, Sensor | None]],
    tree: TransformTree,
    fixed: str,
    by_rig: list[Sensor | None],
    robot: Robot | None,
    rig: Rig | None,
) -> list[str]:
    """Sentences about sensors that nothing places; refuse a recording where that is all."""
    unplaced = [
        topic.frame or topic.name
        for (topic, _, _), sensor in zip(found, by_rig, strict=True)
        if not tree.connected(fixed, topic.frame)
        and not (sensor and robot and sensor.link in robot.links)
    ]
    if len(unplaced) == len(found):
        raise RecordingError(
            f"{file.path}: no sensor can be placed in {fixed}; neither /tf nor a rig places "
            f"{few(unplaced)}. Give a rig whose sensors are named like the topics, or another "
            f"fixed frame."
        )
    warnings: list[str] = []
    if unplaced:
        warnings.append(f"Nothing places {few(unplaced)} in {fixed}; they show nothing.")
    if rig is None:
        return warnings
    if strangers := [t.name for t, _, in_rig in found if in_rig is None]:
        warnings.append(f"The rig '{rig.name}' has no sensor named like {few(strangers)}.")
    there = {in_rig.name for _, _, in_rig in found if in_rig is not None}
    if absent := [sensor.name for sensor in rig.sensors if sensor.name not in there]:
        warnings.append(f"No topic belongs to {few(absent)} of the rig '{rig.name}'.")
    return warnings


def _check_rig(
    file: McapFile, rig: Rig, found: list[tuple[Topic, RecordedSensor, Sensor | None]]
) -> None:
    """RecordingError where the images of a rig's sensor are not of the rig's size."""
    model = rig.model
    for topic, _, in_rig in found:
        if in_rig is not None and topic.grid is not None and not model.delivers(*topic.grid):
            raise RecordingError(
                f"{file.path}: the rig '{rig.name}' has sensors of {model.rows} x {model.columns} "
                f"zones (sensor_model.rows, columns), and the images of {topic.name} have "
                f"{topic.grid[0]} x {topic.grid[1]}."
            )
