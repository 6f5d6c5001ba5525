"""Recorded joint names matched to a robot's, under whatever prefix they were recorded."""

from collections.abc import Collection, Iterable, Sequence
from dataclasses import dataclass


@dataclass(frozen=True)
class JointMatch:
    """Fit of a set of recorded joint names to a robot.

    Attributes:
        joints: {recorded name: the robot's joint}.
        missing: the robot's actuated joints that no recorded name fits, in the robot's order.
        ambiguous: the robot's joints of which it is not clear what recorded name means them; they
            match none.
        prefix: of the recorded names that are taken for this robot, such as "left/fr3_"; None
            where it is not clear which.
        rivals: where several prefixes have all that it takes to be this robot, the recorded name
            of one joint under each of them; else empty.
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
    """Match recorded joint names to a robot's by what follows the prefix.

    Names of one prefix belong together: where several names fit a joint, the one whose prefix has
    all joints that the robot needs is it, so that a gripper's or a mobile base's `wheel_joint1`
    does not hide the arm's.

    Args:
        recorded: names in a recording.
        joints: the robot's actuated joints.
        others: its other joints, which mimic one of them or are fixed; what fits these is no
            candidate for the actuated ones.
        own_prefix: of the robot's own names, "" without one.
        needed: those of `joints` without which a prefix is not this robot.
    """
    cores = {name: name.removeprefix(own_prefix) for name in [*joints, *others]}
    by_prefix = _by_prefix(recorded, cores, joints)
    # One joint is no evidence of a robot: that of a gripper fits as well.
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
        # A rival's joint is part of another robot, even where this one lacks it.
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
    """{prefix: {joint: recorded name}} of the wanted joints, by the longest core that fits."""
    found: dict[str, dict[str, str]] = {}
    for name in recorded:
        fitting = [joint for joint, core in cores.items() if _ends_with(name, core)]
        if fitting and (joint := max(fitting, key=lambda joint: len(cores[joint]))) in wanted:
            found.setdefault(name.removesuffix(cores[joint]), {})[joint] = name
    return found


def _chosen(prefixes: list[str], own: str) -> str | None:
    """The robot's own prefix where it is among them, else the only one."""
    if own in prefixes:
        return own
    return prefixes[0] if len(prefixes) == 1 else None


def _ends_with(recorded: str, core: str) -> bool:
    """Whether a name is `core`, with or without a prefix that ends where a word does."""
    head = recorded.removesuffix(core)
    return recorded == core or (head != recorded and not head[-1].isalnum())
