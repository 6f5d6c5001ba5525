"""Opening a recording: uses of topics, poses of sensors, robot and truth."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path

from recordings.contents import Topic, Use, topics_of
from recordings.decoding import Decoder
from recordings.errors import BrokenFileError, RecordingError
from recordings.frame import Provenance
from recordings.frame_table import FrameTable, frame_table
from recordings.grids import SIZES
from recordings.joints import (
    beyond_limits,
    joint_names,
    joint_positions,
    matched,
    unknown_joints,
)
from recordings.left_out import broken_pieces
from recordings.mcap_file import McapFile
from recordings.nearby import FramePlaces
from recordings.object_meshes import TrueObjects, object_meshes
from recordings.object_truth import object_truth, point_truths
from recordings.placing import chosen_fixed_frame, unplaced_sensors
from recordings.provenance import provenance_of
from recordings.recorded_robot import link_frames, recorded_robot
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
from recordings.transforms import TransformTree, read_transforms
from robot_assets import Rig, Robot, Sensor, load_rig, load_robot

_COMPLETE = 0.9  # mean share of the sensors in a frame, below which there is a warning


def open_recording(
    path: str | Path,
    fixed_frame: str | None = None,
    truth_frame: str | None = None,
    rig: Rig | None = None,
    robot: Robot | None = None,
    mesh_folders: Sequence[str | Path] = (),
) -> Recording:
    """Open a recording.

    Args:
        path: an MCAP file.
        fixed_frame: frame of clouds and truth; default: the root of the tree of /tf, or the
            robot's base.
        truth_frame: a frame whose rigid motion is the truth; default: the recorded twist or pose.
        rig: extrinsics and intrinsics of the sensors, by name, for recordings without; default:
            the rig in the file, or the paper's where the joints are a Panda's.
        robot: default: the recording's description, or a Panda where the joints are a Panda's.
        mesh_folders: with the meshes of the recording's description, beside those of packages that
            are found by their names; nothing else is read because a recording names it.

    Returns:
        The recording; close it, or use it in a `with` statement.

    Raises:
        RecordingError: the file cannot be read, or holds nothing to estimate from.
    """
    chosen = _Chosen(fixed_frame, truth_frame, rig, robot, tuple(mesh_folders))
    try:
        return _opened(McapFile(Path(path)), chosen)
    except BrokenFileError:
        # Use the parts that are not broken.
        return _opened(McapFile(Path(path), salvage=True), chosen)


@dataclass(frozen=True)
class _Chosen:
    """Arguments of `open_recording` beside the path."""

    fixed_frame: str | None
    truth_frame: str | None
    rig: Rig | None
    robot: Robot | None
    mesh_folders: tuple[str | Path, ...]


def _opened(file: McapFile, chosen: _Chosen) -> Recording:
    try:
        return _open(file, chosen)
    except BaseException:
        file.close()
        raise


def _open(file: McapFile, chosen: _Chosen) -> Recording:
    rig, robot = chosen.rig, chosen.robot
    decoder = Decoder(file)
    topics = topics_of(file, decoder)
    damaged = [f"{t.name} is not used: {t.why_not}." for t in topics if t.damaged]
    provenance = provenance_of(file)
    own_rig, about_rig = rig_of(file) if provenance is not None else (None, [])
    if rig is not None and provenance is not None:
        # Our writer stores depth images as in REP 118, for any driver's format in the rig.
        rig = replace(rig, model=rig.model.of_depth_images())
    found = recorded_sensors(topics, decoder, rig, own_rig)
    if not found:
        nothing = _nothing_to_estimate_from(file, topics)
        raise RecordingError(" ".join([nothing, *_about_pieces(file), *damaged]))
    _check_rig(file, rig, found)
    if not decoder.has_stamp_index:
        decoder.read_stamps(t.channel for t in topics if t.use in (Use.DEPTH, Use.STATUS))
    streams = [depth_stream(topic, sensor, topics, decoder) for topic, sensor, _ in found]
    channels = [topic.channel for topic, _, _ in found]
    table = frame_table([decoder.header_stamps(channel) for channel in channels])
    places = FramePlaces(file, decoder, table, channels) if file.long else None
    tree, warnings = read_transforms(topics, decoder, table.stamps, places)
    warnings += (
        damaged
        + about_rig
        + unfit_intrinsics(found, topics)
        + _about_file(file, decoder, table, len(found))
    )

    names = joint_names(topics, decoder)
    if robot is None:
        robot, more = recorded_robot(topics, decoder, names, chosen.mesh_folders)
        warnings += more
    if rig is not None and robot is not None:
        rig.check_links(robot.links, robot.name)
    by_rig: list[Sensor | None] = [in_rig for _, _, in_rig in found]
    if rig is None and robot is not None and set(load_robot().links) <= set(robot.links):
        by_rig = rig_sensors(topics, own_rig or load_rig())

    frames = [topic.frame for topic, _, _ in found]
    robot_poses = None
    if robot is None:
        fixed = chosen_fixed_frame(chosen.fixed_frame, file, tree, frames, None, {})
    else:
        match, more = matched(robot, names)
        in_tree = link_frames(robot, match.prefix, tree.frames)
        fixed = chosen_fixed_frame(chosen.fixed_frame, file, tree, frames, robot, in_tree)
        positions, doubled = joint_positions(topics, decoder, match, table.stamps, places)
        warnings += more + doubled + beyond_limits(robot, positions)
        placed = [link for link, frame in in_tree.items() if frame in tree.frames]
        warnings += unknown_joints(robot, positions, placed)
        robot_poses = RobotPoses(robot, positions, tree, fixed, in_tree)
    poses = SensorPoses(frames, tree, fixed, by_rig, robot_poses, len(table.stamps))
    warnings += unplaced_sensors(file, found, tree, fixed, by_rig, robot, rig, damaged)

    truth, more = object_truth(
        topics, decoder, table.stamps, tree, fixed, chosen.truth_frame, places
    )
    warnings += more
    points, more = point_truths(topics, decoder, table, tree, fixed)
    warnings += more
    objects, more = _true_objects(file, provenance, tree, fixed)
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
            objects=objects,
            fixed_frame=fixed,
            truth_frame=chosen.truth_frame,
            provenance=provenance,
            rig=own_rig,
            warnings=(*warnings, *more),
        )
    )


def _true_objects(
    file: McapFile, provenance: Provenance | None, tree: TransformTree, fixed: str
) -> tuple[TrueObjects, list[str]]:
    """Moving objects of a simulation, none in other files, and warnings."""
    meshes, warnings = object_meshes(file) if provenance is not None else ({}, [])
    return TrueObjects(meshes, tree, fixed), warnings


def _about_file(file: McapFile, decoder: Decoder, table: FrameTable, sensors: int) -> list[str]:
    """Warnings about the file as a whole."""
    warnings = _about_pieces(file)
    if decoder.doubted_index and not (file.cut_short or file.broken_chunks):
        warnings.append(
            "The file's index of stamps does not fit its messages; it is not used, and their "
            "headers are read."
        )
    if decoder.arrival_error:
        warnings.append(
            f"The recording is long and has no index of stamps: times of arrival serve, which in a "
            f"sample differ from those in the messages by up to {1e3 * decoder.arrival_error:.1f} "
            f"ms."
        )
    if table.completeness < _COMPLETE:
        warnings.append(
            f"A frame holds {table.completeness * sensors:.1f} of the {sensors} sensors on "
            f"average; their readings are not taken at the same time, or many are lost."
        )
    return warnings


def _about_pieces(file: McapFile) -> list[str]:
    """Warnings about parts of the file that cannot be used."""
    warnings: list[str] = []
    if file.cut_short:
        warnings.append("The file is cut short; what it holds up to there is used.")
    if file.broken_chunks:
        warnings.append(broken_pieces(file.broken_chunks))
    return warnings


def _nothing_to_estimate_from(file: McapFile, topics: list[Topic]) -> str:
    listed = [f"{t.name} ({t.channel.schema_name or t.channel.encoding})" for t in topics[:6]]
    others = f" and {len(topics) - 6} more" if len(topics) > 6 else ""
    held = f"it holds {', '.join(listed)}{others}" if topics else "it holds no topics"
    return (
        f"{file.path} has no ranges of a sensor, such as depth images of {SIZES}, so there is "
        f"nothing to estimate from; {held}."
    )


def _check_rig(
    file: McapFile, rig: Rig | None, found: list[tuple[Topic, RecordedSensor, Sensor | None]]
) -> None:
    """Raise RecordingError where images of a rig's sensor have another size than the rig's."""
    if rig is None:
        return
    model = rig.model
    for topic, _, in_rig in found:
        if in_rig is not None and topic.grid is not None and not model.delivers(*topic.grid):
            raise RecordingError(
                f"{file.path}: the rig '{rig.name}' has sensors of {model.rows} x {model.columns} "
                f"zones (sensor_model.rows, columns), and the images of {topic.name} have "
                f"{topic.grid[0]} x {topic.grid[1]}."
            )
