"""Matching of recorded joint names to a robot's, whose prefix may differ."""

from collections.abc import Collection, Iterable, Sequence
from dataclasses import dataclass


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
    taken: dict[str, str] = {}
    ambiguous: list[str] = []
    for joint in joints:
        preferred = [
            by_prefix[p][joint]
            for p in (prefix, own_prefix)
            if p in by_prefix and joint in by_prefix[p]
        ]
        # A rival's joint belongs to another robot, even where this one has no such joint.
        free = [n[joint] for p, n in by_prefix.items() if p not in rivals and joint in n]
        if preferred or len(free) == 1:
            taken[(preferred or free)[0]] = joint
        elif free or (prefix is None and any(joint in names for names in rivals.values())):
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
    found: dict[str, dict[str, str]] = {}
    for name in recorded:
        fitting = [joint for joint, core in cores.items() if _ends_with(name, core)]
        if fitting and (joint := max(fitting, key=lambda joint: len(cores[joint]))) in wanted:
            found.setdefault(name.removesuffix(cores[joint]), {})[joint] = name
    return found


def _chosen(prefixes: list[str], own: str) -> str | None:
    """The robot's own prefix where it is among them, else the only one, else None."""
    if own in prefixes:
        return own
    return prefixes[0] if len(prefixes) == 1 else None


def _ends_with(recorded: str, core: str) -> bool:
    """Whether a name is `core`, alone or after a prefix that ends at a word boundary."""
    head = recorded.removesuffix(core)
    return recorded == core or (head != recorded and not head[-1].isalnum())
