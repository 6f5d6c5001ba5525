"""Robot of a recording, and the frames of its links in /tf."""

from collections.abc import Collection, Sequence
from pathlib import Path

from recordings.contents import Topic, Use
from recordings.decoding import Decoder
from recordings.joints import matched
from robot_assets import Robot, RobotError, load_robot


def recorded_robot(
    topics: list[Topic], decoder: Decoder, joints: list[str], mesh_folders: Sequence[str | Path]
) -> tuple[Robot | None, list[str]]:
    """Find the robot of a recording: by its description, or a Panda by its joints.

    Args:
        topics: of the file.
        decoder: of the file.
        joints: all recorded names.
        mesh_folders: with the meshes of the description.

    Returns:
        The robot, None where there is none, and warnings about the reason.
    """
    described = next((topic for topic in topics if topic.use is Use.ROBOT), None)
    if described is not None:
        try:
            robot = load_robot(decoder.first(described.channel).data, mesh_folders)
        except RobotError as error:
            return None, [str(error)]
        return robot, []
    panda = load_robot()
    match, more = matched(panda, joints)
    arm = [joint for joint in panda.joint_names if "finger" not in joint]
    if set(arm) <= set(match.joints.values()):
        return panda, []
    return None, more if match.rivals else []


def link_frames(robot: Robot, prefix: str | None, frames: Collection[str]) -> dict[str, str]:
    """Find the names of a robot's links in the recording's /tf.

    Publishers give joints and links the same prefix: `fr3_joint1` goes with `fr3_link0`. A
    namespace before the joints, as in `left/fr3_joint1`, may be missing in /tf.

    Args:
        robot: the robot.
        prefix: of its recorded joints, None where unknown.
        frames: of /tf.

    Returns:
        {link: frame} of every link; the link's own name where /tf has no link with the prefix.
    """
    prefix = (prefix or "").lstrip("/")
    for candidate in dict.fromkeys([prefix, prefix.rpartition("/")[2]]):
        names = robot.link_names(candidate)
        if any(name in frames for name in names.values()):
            return names
    return {link: link for link in robot.links}
