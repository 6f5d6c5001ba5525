"""Forward kinematics of a URDF, in time linear in the number of its links."""

from collections.abc import Collection, Mapping
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from robot_assets.errors import RobotError

if TYPE_CHECKING:
    import yourdfpy

ROTARY = ("revolute", "continuous")
_MOVING = (*ROTARY, "prismatic")


class Kinematics:
    """Tree of a robot's links and joints.

    Args:
        urdf: a loaded description.

    Attributes:
        base: the link that is no joint's child.
        links: in the order of the description.
        joints: from the base outwards, each before those of the links behind it.

    Raises:
        RobotError: the joints are not those of one tree; the text is a reason.
    """

    def __init__(self, urdf: "yourdfpy.URDF") -> None:
        self.links = tuple(str(link) for link in urdf.link_map)
        above = self._above = dict[str, Any]()
        for joint in urdf.robot.joints:
            for end in (joint.parent, joint.child):
                if end not in urdf.link_map:
                    raise RobotError(f"joint {joint.name} has the link {end}, which is not there")
            if above.setdefault(str(joint.child), joint) is not joint:
                raise RobotError(f"link {joint.child} is the child of two joints")
        bases = [link for link in self.links if link not in above]
        if len(bases) != 1:
            ends = ", ".join(bases[:3]) or "none"
            raise RobotError(f"it has {len(bases)} links without a parent ({ends}) instead of one")
        self.base = bases[0]
        behind: dict[str, list[Any]] = {}
        for joint in above.values():
            behind.setdefault(str(joint.parent), []).append(joint)
        self.joints: list[Any] = list(behind.get(self.base, []))
        for joint in self.joints:  # grows while it is walked through
            self.joints += behind.get(str(joint.child), [])
        if len(self.joints) < len(above):
            raise RobotError("its joints form a loop")

    def poses(self, positions: Mapping[str, float]) -> dict[str, NDArray[np.float64]]:
        """{link: T_base_link (4, 4)} with the joints at these positions (rad or m).

        A joint without a position is at 0; so are floating and planar ones.
        """
        found = {self.base: np.eye(4)}
        for joint in self.joints:
            found[str(joint.child)] = found[str(joint.parent)] @ _pose(joint, positions)
        return {link: found[link] for link in self.links}

    def placed_by(self, joints: Collection[str]) -> frozenset[str]:
        """Links whose pose is known when the positions of these joints are.

        An unknown rotary joint leaves the links behind it unknown. An unknown prismatic joint,
        such as a finger's, does not: the error is at most its short travel.
        """
        placed = {self.base}
        for joint in self.joints:
            known = joint.type not in ROTARY or driver(joint) in joints
            if known and str(joint.parent) in placed:
                placed.add(str(joint.child))
        return frozenset(placed)

    def needed_by(self, link: str) -> frozenset[str]:
        """Joints whose positions must be known to place a link, in the sense of `placed_by`."""
        needed: set[str] = set()
        while (joint := self._above.get(link)) is not None:
            if joint.type in ROTARY:
                needed.add(driver(joint))
            link = str(joint.parent)
        return frozenset(needed)


def driver(joint: Any) -> str:  # noqa: ANN401 (yourdfpy has no types)
    """Name of the joint whose position moves this one: its own, or the one that it mimics."""
    return str(joint.mimic.joint if joint.mimic else joint.name)


def _pose(joint: Any, positions: Mapping[str, float]) -> NDArray[np.float64]:  # noqa: ANN401
    """T_parent_child (4, 4) of a joint."""
    from trimesh.transformations import rotation_matrix, translation_matrix

    origin = np.eye(4) if joint.origin is None else joint.origin
    if joint.type not in _MOVING:
        return origin
    position = float(positions.get(driver(joint), 0.0))
    if joint.mimic:
        position = position * joint.mimic.multiplier + joint.mimic.offset
    if joint.type == "prismatic":
        return origin @ translation_matrix(position * joint.axis)
    return origin @ rotation_matrix(position, joint.axis)
