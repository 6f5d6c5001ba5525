"""The fixed frame of a recording, and the sensors that nothing or too little places in it."""

from collections.abc import Mapping

from recordings.contents import Topic, natural_key
from recordings.errors import RecordingError, few
from recordings.mcap_file import McapFile
from recordings.sensors import RecordedSensor
from recordings.transforms import TransformTree
from robot_assets import Rig, Robot, Sensor


def chosen_fixed_frame(
    asked: str | None,
    file: McapFile,
    tree: TransformTree,
    frames: list[str],
    robot: Robot | None,
    link_frames: Mapping[str, str],
) -> str:
    """Choose the frame in which clouds and truth are.

    Args:
        asked: by a person, None to choose the root above most sensors, or the robot's base.
        file: the recording's.
        tree: its /tf.
        frames: of its sensors.
        robot: its robot, None without.
        link_frames: {link: its frame in /tf} of the robot.

    Returns:
        A frame; where a person asked for a link by the robot's own name, the link's in /tf.

    Raises:
        RecordingError: there is no such frame, or nothing relates the sensors to each other.
    """
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


def unplaced_sensors(
    file: McapFile,
    found: list[tuple[Topic, RecordedSensor, Sensor | None]],
    tree: TransformTree,
    fixed: str,
    by_rig: list[Sensor | None],
    robot: Robot | None,
    rig: Rig | None,
) -> list[str]:
    """Sentences about sensors that nothing places, and about a rig that does not fit in full.

    Args:
        file: the recording's.
        found: for each depth topic its sensor, and that of `rig` which it matches.
        tree: poses of /tf.
        fixed: the fixed frame.
        by_rig: the sensor of a rig, chosen or default, that places each, None without.
        robot: on which the rig's sensors are, None without.
        rig: one that a person chose, None without.

    Raises:
        RecordingError: no sensor is placed at all.
    """
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
    warnings += _on_one_spot(found, tree, fixed, by_rig)
    if rig is None:
        return warnings
    if strangers := [t.name for t, _, in_rig in found if in_rig is None]:
        warnings.append(f"The rig '{rig.name}' has no sensor named like {few(strangers)}.")
    there = {in_rig.name for _, _, in_rig in found if in_rig is not None}
    if absent := [sensor.name for sensor in rig.sensors if sensor.name not in there]:
        warnings.append(f"No topic belongs to {few(absent)} of the rig '{rig.name}'.")
    return warnings


def _on_one_spot(
    found: list[tuple[Topic, RecordedSensor, Sensor | None]],
    tree: TransformTree,
    fixed: str,
    by_rig: list[Sensor | None],
) -> list[str]:
    """Sentences about sensors that one and the same sensor of the rig places."""
    topics: dict[str, list[str]] = {}
    for (topic, _, _), sensor in zip(found, by_rig, strict=True):
        if sensor and not tree.connected(fixed, topic.frame):
            topics.setdefault(sensor.name, []).append(topic.name)
    return [
        f"The rig has one sensor, {name}, for the topics {few(names)}, and places them on one "
        f"spot; it needs one for each, named like its topic with the part that differs."
        for name, names in topics.items()
        if len(names) > 1
    ]
