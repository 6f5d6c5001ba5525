"""Choice of the fixed frame, and warnings about sensors without a pose in it."""

from collections.abc import Mapping

from recordings.contents import Topic, natural_key
from recordings.errors import RecordingError, few
from recordings.mcap_file import McapFile
from recordings.sensors import RecordedSensor
from recordings.transforms import TransformTree
from robot_assets import Rig, Robot, Sensor


def chosen_fixed_frame(
    chosen: str | None,
    file: McapFile,
    tree: TransformTree,
    frames: list[str],
    robot: Robot | None,
    link_frames: Mapping[str, str],
) -> str:
    """Choose the frame of clouds and truth.

    Args:
        chosen: the user's choice; None for the root above most sensors, or the robot's base.
        file: of the recording.
        tree: poses of /tf.
        frames: of the sensors.
        robot: of the recording, None without.
        link_frames: {link: its frame in /tf} of the robot.

    Returns:
        A frame; for a link that the user named as the robot does, its frame in /tf.

    Raises:
        RecordingError: there is no such frame, or the sensors have no poses relative to each other.
    """
    known = tree.frames | set(frames) | set(link_frames) | set(link_frames.values())
    if chosen is not None:
        if chosen not in known:
            listed = [*sorted(known - set(frames)), *sorted(frames, key=natural_key)]
            raise RecordingError(f"{file.path} has no frame {chosen}; it has {few(listed)}.")
        return chosen if chosen in tree.frames else link_frames.get(chosen, chosen)
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
    damaged: list[str],
) -> list[str]:
    """Warnings about sensors without a pose, and about a rig that does not fit the topics.

    Args:
        file: of the recording.
        found: for each depth topic its sensor, and the sensor of `rig` that it matches.
        tree: poses of /tf.
        fixed: the fixed frame.
        by_rig: for each, the sensor of the chosen or default rig with its extrinsics, None without.
        robot: that carries the rig, None without.
        rig: the user's choice, None without.
        damaged: sentences about topics that could have placed them.

    Raises:
        RecordingError: no sensor has a pose.
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
            f"fixed frame. {' '.join(damaged)}".strip()
        )
    warnings: list[str] = []
    if unplaced:
        warnings.append(f"Nothing places {few(unplaced)} in {fixed}; their readings are left out.")
    warnings += _on_one_spot(found, tree, fixed, by_rig)
    if rig is None:
        return warnings
    if unmatched := [t.name for t, _, in_rig in found if in_rig is None]:
        warnings.append(f"The rig '{rig.name}' has no sensor named like {few(unmatched)}.")
    there = {in_rig.name for _, _, in_rig in found if in_rig is not None}
    if missing := [sensor.name for sensor in rig.sensors if sensor.name not in there]:
        warnings.append(f"No topic belongs to {few(missing)} of the rig '{rig.name}'.")
    return warnings


def _on_one_spot(
    found: list[tuple[Topic, RecordedSensor, Sensor | None]],
    tree: TransformTree,
    fixed: str,
    by_rig: list[Sensor | None],
) -> list[str]:
    """Warnings about topics that match the same sensor of the rig, and so have the same pose."""
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
