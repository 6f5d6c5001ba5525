"""Robot from a URDF: links, joints, meshes, and forward kinematics."""

import re
import threading
from collections.abc import Collection, Iterable, Mapping
from functools import cached_property, lru_cache
from io import BytesIO
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import numpy as np
import trimesh
import yourdfpy
from numpy.typing import NDArray

from robot_assets.errors import RobotError
from robot_assets.input_files import open_file
from robot_assets.joint_match import JointMatch, match_joints
from robot_assets.meshes import link_meshes, panda_urdf_path, resolve_mesh

Transform = NDArray[np.float64]
_LARGEST = 20_000_000  # bytes of a URDF file; the largest of robots have a few
_ROTARY = ("revolute", "continuous")


class Robot:
    """Robot from a URDF.

    Args:
        urdf: a loaded description; `load_robot` loads one from a file or a text.
        name: shown on screen.
        text: the unchanged description.
    """

    def __init__(self, urdf: yourdfpy.URDF, name: str, text: str) -> None:
        self._urdf = urdf
        self.text = text
        self._lock = threading.Lock()  # yourdfpy keeps the configuration inside the URDF object
        self.name = name
        self.base = str(urdf.base_link)
        self.links = tuple(str(link) for link in urdf.link_map)
        self.joint_names = tuple(str(joint) for joint in urdf.actuated_joint_names)
        self.joint_limits = {
            name: (float(limit.lower), float(limit.upper))
            for name in self.joint_names
            if (limit := urdf.joint_map[name].limit) is not None
            and urdf.joint_map[name].type != "continuous"
            and limit.lower is not None
            and limit.upper is not None
        }

    def match_joints(self, recorded: Iterable[str]) -> JointMatch:
        """Match recorded joint names to this robot's, exactly or by the part after the prefix.

        `panda_joint1`, `fer_joint1`, `fr3_joint1` and `/left/panda_joint1` all mean the joint
        whose name without the robot's own prefix is `joint1`. A prefix is this robot's if it has
        all rotary joints; fingers may be missing.
        """
        rotary = [name for name in self.joint_names if self._urdf.joint_map[name].type in _ROTARY]
        return match_joints(
            recorded,
            self.joint_names,
            [name for name, _ in self._joints if name not in self.joint_names],
            self._prefix,
            rotary or self.joint_names,
        )

    def link_names(self, prefix: str) -> dict[str, str]:
        """{link: its name with `prefix` instead of the robot's own} of every link."""
        own = self._prefix
        return {
            link: prefix + link.removeprefix(own) if link.startswith(own) else link
            for link in self.links
        }

    def links_placed_by(self, joints: Collection[str]) -> frozenset[str]:
        """Links whose pose is known when the positions of these joints are.

        An unknown rotary joint leaves the links behind it unknown. An unknown prismatic joint,
        such as a finger's, does not: the error is at most its short travel.
        """
        driver = {name: joint.mimic.joint if joint.mimic else name for name, joint in self._joints}
        unknown = {
            str(joint.child)
            for name, joint in self._joints
            if joint.type in _ROTARY and driver[name] not in joints
        }
        return frozenset(link for link in self.links if unknown.isdisjoint(self._chain(link)))

    def outside_limits(self, positions: Mapping[str, float], tolerance: float = 1e-3) -> list[str]:
        """Messages about joints beyond their limits by more than `tolerance` (rad or m)."""
        return [
            f"{name} is at {positions[name]:.3f}, outside its limits {low:.3f} to {high:.3f}."
            for name, (low, high) in self.joint_limits.items()
            if name in positions and not low - tolerance <= positions[name] <= high + tolerance
        ]

    def link_poses(self, positions: Mapping[str, float]) -> dict[str, Transform]:
        """Forward kinematics.

        Args:
            positions: {joint: rad or m}; missing joints are at 0, or at their limit nearest to 0.

        Returns:
            {link: T_base_link (4, 4)} of every link.
        """
        configuration = np.array([positions.get(n, self._rest(n)) for n in self.joint_names])
        with self._lock:
            self._urdf.update_cfg(configuration)
            return {
                link: np.array(self._urdf.get_transform(link, self.base)) for link in self.links
            }

    @cached_property
    def parents(self) -> dict[str, str]:
        """{link: its parent link} of every link but the base."""
        return {str(joint.child): str(joint.parent) for joint in self._urdf.robot.joints}

    @cached_property
    def fixed_links(self) -> frozenset[str]:
        """Links fixed to their parent."""
        return frozenset(str(j.child) for j in self._urdf.robot.joints if j.type == "fixed")

    @cached_property
    def visual_meshes(self) -> dict[str, trimesh.Trimesh]:
        """{link: one mesh in the link's frame, metres, coloured per vertex} of visible links.

        Missing files are left out, see `missing_meshes`; a broken one raises RobotError.
        """
        return link_meshes(self._urdf, "visuals")

    @cached_property
    def collision_meshes(self) -> dict[str, trimesh.Trimesh]:
        """{link: one mesh in the link's frame, metres} of links with collision geometry.

        Missing files are left out, see `missing_meshes`; a broken one raises RobotError.
        """
        return link_meshes(self._urdf, "collisions")

    @cached_property
    def missing_meshes(self) -> tuple[str, ...]:
        """Mesh files named in the description that do not exist."""
        return tuple(
            geometry.mesh.filename
            for link in self._urdf.link_map.values()
            for part in [*link.visuals, *link.collisions]
            if (geometry := part.geometry).mesh is not None
            and not Path(self._urdf._filename_handler(geometry.mesh.filename)).is_file()
        )

    @property
    def _joints(self) -> list[tuple[str, Any]]:
        return [(str(name), joint) for name, joint in self._urdf.joint_map.items()]

    def _chain(self, link: str) -> list[str]:
        """A link and its ancestors, down to the base."""
        chain = [link]
        while chain[-1] in self.parents:
            chain.append(self.parents[chain[-1]])
        return chain

    @cached_property
    def _prefix(self) -> str:
        # "joint_" is no prefix: the rest of the name must still contain "joint".
        if not all("joint" in name.partition("_")[2] for name in self.joint_names):
            return ""
        heads = {re.match(r"^[A-Za-z0-9]+_", name) for name in self.joint_names}
        texts = {head.group() if head else "" for head in heads}
        return texts.pop() if len(texts) == 1 else ""

    def _rest(self, joint: str) -> float:
        low, high = self.joint_limits.get(joint, (-np.inf, np.inf))
        return float(np.clip(0.0, low, high))


def load_robot(source: str | Path | None = None) -> Robot:
    """Load a robot.

    Args:
        source: path of a URDF file; None is the Franka Emika Panda of the example-robot-data
            package. A string that starts with "<" is the URDF itself, as in /robot_description.

    Raises:
        RobotError: the file does not exist or is not a URDF.
    """
    if isinstance(source, str) and source.lstrip().startswith("<"):
        where, text, folder = "The robot description", source, None
    else:
        path = panda_urdf_path() if source is None else Path(source)
        where, folder = str(path), path.parent
        text = _read(path)
    return _robot(text, where, folder)


def _read(path: Path) -> str:
    try:
        with open_file(path) as file:
            content = file.read(_LARGEST + 1)
    except OSError as error:
        raise RobotError(f"{path} cannot be read as a URDF file: {error.strerror}.") from error
    if len(content) > _LARGEST:
        raise RobotError(
            f"{path} has more than {_LARGEST // 1_000_000} MB, too much for a URDF; check the name."
        )
    try:
        return content.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        raise RobotError(f"{path} is not a URDF: it is not a text file.") from error


@lru_cache(maxsize=16)
def _robot(text: str, where: str, folder: Path | None) -> Robot:
    # Recordings of the same robot share it, so that its meshes are loaded once.
    _check_is_urdf(where, text)
    try:
        urdf = yourdfpy.URDF.load(
            BytesIO(text.encode("utf-8")),
            filename_handler=lambda name: resolve_mesh(name, folder),
            load_meshes=False,
            build_scene_graph=True,
        )
        robot = Robot(urdf, str(urdf.robot.name), text)
        robot.link_poses({})  # fails here where joints form a loop
    except Exception as error:  # yourdfpy has no error type of its own
        raise RobotError(f"{where} is not a URDF that can be used: {error}.") from error
    return robot


def _check_is_urdf(where: str, text: str) -> None:
    # yourdfpy repairs broken XML silently and fails on the result.
    try:
        root = ElementTree.fromstring(text.strip().encode("utf-8"))
    except ElementTree.ParseError as error:
        raise RobotError(f"{where} is not a URDF: {error}.") from error
    if root.tag != "robot" or not root.get("name"):
        raise RobotError(f"{where} is not a URDF: it must be a <robot> with a name.")
    if root.find("link") is None:
        raise RobotError(f"{where} has no links.")
    if any(not mesh.get("filename") for mesh in root.iter("mesh")):
        raise RobotError(f"{where} has a <mesh> without a filename.")
