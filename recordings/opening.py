"""Opening a recording: what each topic is, where the sensors are, what the truth is."""

from collections.abc import Mapping
from dataclasses import fields
from pathlib import Path

from recordings.contents import ZONES, Topic, Use, natural_key, topics_of
from recordings.decoding import Decoder
from recordings.errors import BrokenFileError, RecordingError, few
from recordings.frame import Provenance
from recordings.frame_table import FrameTable, frame_table
from recordings.joints import (
    beyond_limits,
    joint_names,
    joint_positions,
    matched,
    unknown_joints,
)
from recordings.mcap_file import McapFile
from recordings.object_truth import object_truth, point_truths
from recordings.recorded_robot import link_frames, recorded_robot
from recordings.recording import Parts, Recording
from recordings.robot_poses import RobotPoses
from recordings.sensor_poses import SensorPoses
from recordings.sensors import RecordedSensor, depth_stream, recorded_sensors
from recordings.stamp_index import STAMP_INDEX
from recordings.transforms import TransformTree, read_transforms
from robot_assets import Rig, Robot, Sensor, load_rig, load_robot

PROVENANCE_RECORD = "tofscope"
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
    if rig is not None:
        _check_rig(file, rig)
    found = recorded_sensors(topics, decoder, rig)
    if not found:
        raise RecordingError(_nothing_to_estimate_from(file, topics))
    if STAMP_INDEX not in file.attachments:
        decoder.read_stamps(t.channel for t in topics if t.use in (Use.DEPTH, Use.STATUS))
    streams = [depth_stream(topic, sensor, topics, decoder) for topic, sensor, _ in found]
    table = frame_table([decoder.header_stamps(topic.channel) for topic, _, _ in found])
    tree, warnings = read_transforms(topics, decoder, table.stamps)
    warnings += _about_file(file, table, len(found))

    names = joint_names(topics, file, decoder)
    if robot is None:
        robot, said = recorded_robot(topics, decoder, names)
        warnings += said
    if robot is not None and (missing := robot.missing_meshes):
        count = "One mesh" if len(missing) == 1 else f"{len(missing)} meshes"
        warnings.append(
            f"{count} of {robot.name} not on this machine, such as {missing[0]}; what they show "
            f"is neither drawn nor removed from the clouds."
        )
    if rig is not None and robot is not None:
        rig.check_links(robot.links, robot.name)
    rig_sensors: list[Sensor | None] = [in_rig for _, _, in_rig in found]
    if rig is None and robot is not None and set(load_robot().links) <= set(robot.links):
        default = recorded_sensors(topics, decoder, load_rig())
        rig_sensors = [in_rig for _, _, in_rig in default]

    frames = [topic.frame for topic, _, _ in found]
    robot_poses = None
    if robot is None:
        fixed = _fixed_frame(fixed_frame, file, tree, frames, None, {})
    else:
        match, said = matched(robot, names)
        in_tree = link_frames(robot, match.prefix, tree.frames)
        fixed = _fixed_frame(fixed_frame, file, tree, frames, robot, in_tree)
        positions, doubled = joint_positions(topics, file, decoder, match, table.stamps)
        warnings += said + doubled + beyond_limits(robot, positions)
        placed = [link for link, frame in in_tree.items() if frame in tree.frames]
        warnings += unknown_joints(robot, positions, placed)
        robot_poses = RobotPoses(robot, positions, tree, fixed, in_tree)
    poses = SensorPoses(frames, tree, fixed, rig_sensors, robot_poses, len(table.stamps))
    warnings += _unplaced_sensors(file, found, tree, fixed, rig_sensors, robot, rig)

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
            provenance=provenance_of(file),
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


def provenance_of(file: McapFile) -> Provenance | None:
    """Where a file comes from, by its metadata; None for files that we did not write."""
    record = file.metadata.get(PROVENANCE_RECORD)
    if record is None:
        return None
    try:
        return Provenance(
            simulated=record["simulated"] == "true",
            scenario=record["scenario"],
            speed=float(record["speed"]),
            trial=int(record["trial"]),
            seed=int(record["seed"]),
            noise=record["noise"],
            command=record["command"],
            imperfections=tuple(record.get("imperfections", "").split()),
        )
    except (KeyError, ValueError) as error:
        names = ", ".join(f.name for f in fields(Provenance))
        raise RecordingError(
            f"{file.path}: its metadata record '{PROVENANCE_RECORD}' must hold {names}; "
            f"wrong or missing: {error}."
        ) from error


def _nothing_to_estimate_from(file: McapFile, topics: list[Topic]) -> str:
    shown = [f"{t.name} ({t.channel.schema_name or t.channel.encoding})" for t in topics[:6]]
    more = f" and {len(topics) - 6} more" if len(topics) > 6 else ""
    held = f"it holds {', '.join(shown)}{more}" if topics else "it holds no topics"
    return f"{file.path} has no 8 x 8 depth images, so there is nothing to estimate from; {held}."


def _fixed_frame(
    asked: str | None,
    file: McapFile,
    tree: TransformTree,
    frames: list[str],
    robot: Robot | None,
    link_frames: Mapping[str, str],
) -> str:
    known = tree.frames | set(frames) | set(link_frames) | set(link_frames.values())
    if asked is not None:
        if asked not in known:
            listed = [*sorted(known - set(frames)), *sorted(frames, key=natural_key)]
            raise RecordingError(f"{file.path} has no frame {asked}; it has {few(listed)}.")
        return asked if asked in tree.frames else link_frames.get(asked, asked)
    in_tree = [frame for frame in frames if frame in tree.frames]
    if in_tree:
        roots = [tree.root_of(frame) for frame in in_tree]
        return max(dict.fromkeys(roots), key=roots.count)
    if robot:
        return link_frames[robot.base]
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
    rig_sensors: list[Sensor | None],
    robot: Robot | None,
    rig: Rig | None,
) -> list[str]:
    """Sentences about sensors that nothing places; refuse a recording where that is all."""
    unplaced = [
        topic.frame or topic.name
        for (topic, _, _), sensor in zip(found, rig_sensors, strict=True)
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
    warnings += _on_one_spot(found, tree, fixed, rig_sensors)
    if rig is not None and (strangers := [t.name for t, _, in_rig in found if in_rig is None]):
        warnings.append(f"The rig '{rig.name}' has no sensor named like {few(strangers)}.")
    return warnings


def _on_one_spot(
    found: list[tuple[Topic, RecordedSensor, Sensor | None]],
    tree: TransformTree,
    fixed: str,
    rig_sensors: list[Sensor | None],
) -> list[str]:
    """Sentences about sensors that one and the same sensor of the rig places."""
    topics: dict[str, list[str]] = {}
    for (topic, _, _), sensor in zip(found, rig_sensors, strict=True):
        if sensor and not tree.connected(fixed, topic.frame):
            topics.setdefault(sensor.name, []).append(topic.name)
    return [
        f"The rig has one sensor, {name}, for the topics {few(names)}, and places them on one "
        f"spot; it needs one for each, named like its topic with the part that differs."
        for name, names in topics.items()
        if len(names) > 1
    ]


def _check_rig(file: McapFile, rig: Rig) -> None:
    if (rig.model.rows, rig.model.columns) != ZONES:
        raise RecordingError(
            f"{file.path}: the rig '{rig.name}' has sensors of {rig.model.rows} x "
            f"{rig.model.columns} zones (sensor_model.rows, columns), and recordings "
            f"{ZONES[0]} x {ZONES[1]}."
        )
