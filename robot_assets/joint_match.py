"""Matching of recorded joint names to a robot's, whose prefix may differ."""

from collections.abc import Collection, Iterable, Sequence
from dataclasses import dataclass

LONGEST_NAME = 1000
"""Characters of the name of a joint or a link."""


@dataclass(frozen=True)
class JointMatch:
    """Recorded joint names matched to a robot's joints.

    Attributes:
        joints: {recorded name: the robot's joint}.
        missing: the robot's actuated joints that no recorded name fits, in the robot's order.
        ambiguous: the robot's joints that several recorded names fit; they match none.
        prefix: of the recorded names of this robot, such as "left/fr3_"; None where ambiguous.
        rivals: where several prefixes have all needed joints, the recorded name of one joint for
            each such prefix; else empty.
    """

    joints: dict[str, str]
    missing: tuple[str, ...]
    ambiguous: tuple[str, ...]
    prefix: str | None
    rivals: tuple[str, ...]


def match_joints(
    recorded: Iterable[str],
    joints: Sequence[str],
    others: Iterable[str],
    own_prefix: str,
    needed: Sequence[str],
) -> JointMatch:
    """Match recorded joint names to a robot's by the part after the prefix.

    Names with the same prefix belong together. Where several names fit a joint, the one whose
    prefix has all needed joints is chosen, so that `wheel_joint1` of a gripper or a mobile base
    does not hide the arm's joint.

    Args:
        recorded: names in a recording.
        joints: the robot's actuated joints.
        others: its mimic and fixed joints; a recorded name that fits one of these is no candidate
            for an actuated joint.
        own_prefix: of the robot's own names, "" without one.
        needed: those of `joints` that a prefix must have to be this robot.
    """
    cores = {name: name.removeprefix(own_prefix) for name in [*joints, *others]}
    by_prefix = _by_prefix(recorded, cores, joints)
    # A single joint is no evidence: a gripper's would fit as well.
    complete = [
        p for p, names in by_prefix.items() if len(needed) > 1 and set(needed) <= set(names)
    ]
    prefix = _chosen(complete or list(by_prefix), own_prefix)

    rivals = {p: by_prefix[p] for p in complete if p != prefix}
    free_names: dict[str, list[str]] = {}
    # A rival's joint belongs to another robot, even where this one has no such joint.
    for p, names in by_prefix.items():
        for joint, name in names.items() if p not in rivals else ():
            free_names.setdefault(joint, []).append(name)
    of_rivals = {joint for names in rivals.values() for joint in names}
    taken: dict[str, str] = {}
    ambiguous: list[str] = []
    for joint in joints:
        preferred = [
            by_prefix[p][joint]
            for p in (prefix, own_prefix)
            if p in by_prefix and joint in by_prefix[p]
        ]
        free = free_names.get(joint, [])
        if preferred or len(free) == 1:
            taken[(preferred or free)[0]] = joint
        elif free or (prefix is None and joint in of_rivals):
            ambiguous.append(joint)
    known = {*taken.values(), *ambiguous}
    return JointMatch(
        joints=taken,
        missing=tuple(joint for joint in joints if joint not in known),
        ambiguous=tuple(ambiguous),
        prefix=prefix,
        rivals=tuple(by_prefix[p][needed[0]] for p in complete) if rivals else (),
    )


def _by_prefix(
    recorded: Iterable[str], cores: dict[str, str], wanted: Collection[str]
) -> dict[str, dict[str, str]]:
    """{prefix: {joint: recorded name}} of the wanted joints; the longest core that fits wins."""
    joint_of = {core: joint for joint, core in reversed(cores.items())}
    longest = max(map(len, joint_of), default=0)
    wanted = set(wanted)
    found: dict[str, dict[str, str]] = {}
    for name in recorded:
        if len(name) > LONGEST_NAME:
            continue
        # A core may begin where a word of the name does; the first that fits is the longest.
        starts = (i for i in range(max(len(name) - longest, 0), len(name)) if _begins(name, i))
        start = next((i for i in starts if name[i:] in joint_of), None)
        if start is not None and (joint := joint_of[name[start:]]) in wanted:
            found.setdefault(name[:start], {})[joint] = name
    return found


def _chosen(prefixes: list[str], own: str) -> str | None:
    """The robot's own prefix where it is among them, else the only one, else None."""
    if own in prefixes:
        return own
    return prefixes[0] if len(prefixes) == 1 else None


def _begins(name: str, at: int) -> bool:
    """Whether a word of a name may begin at a place."""
    return at == 0 or not name[at - 1].isalnum()
