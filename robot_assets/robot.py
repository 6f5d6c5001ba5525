"""Robot from a URDF: links, joints, meshes, and forward kinematics."""

import hashlib
import logging
import re
from collections.abc import Collection, Iterable, Mapping, Sequence
from functools import cached_property, lru_cache
from io import BytesIO
from pathlib import Path
from typing import TYPE_CHECKING
from xml.etree import ElementTree

import numpy as np
from numpy.typing import NDArray

from robot_assets.errors import RobotError
from robot_assets.input_files import read_file
from robot_assets.joint_match import LONGEST_NAME, JointMatch, match_joints
from robot_assets.kinematics import ROTARY, Kinematics
from robot_assets.mesh_files import MeshPlaces, panda_urdf_path
from robot_assets.meshes import SHAPES, RobotMeshes

if TYPE_CHECKING:
    import trimesh
    import yourdfpy

Transform = NDArray[np.float64]
MOST_LINKS = 20_000
"""Links of a robot; a description with more is refused."""
_LARGEST = 16 * 2**20
"""Bytes of a description; the largest of robots have a few MB."""
_FARTHEST = 1e5
"""Metres from the base that a link at rest may be."""

# What it says of broken descriptions is said in a sentence of ours.
logging.getLogger("yourdfpy").propagate = False
logging.getLogger("yourdfpy").addHandler(logging.NullHandler())


class Robot:
    """Robot from a URDF.

    Args:
        urdf: a loaded description; `load_robot` loads one from a file or a text.
        name: shown on screen.
        text: the unchanged description.
        places: where its mesh files may lie.
        unknown: links with shapes of no known kind, which `urdf` lacks.

    Raises:
        RobotError: its joints are not those of one tree; the text is a reason.
    """

    def __init__(
        self,
        urdf: "yourdfpy.URDF",
        name: str,
        text: str,
        places: MeshPlaces,
        unknown: Sequence[str] = (),
    ) -> None:
        self._urdf = urdf
        self.text = text
        self.name = name
        self._kinematics = Kinematics(urdf)
        self._meshes = RobotMeshes(urdf, places, unknown)
        self.base = self._kinematics.base
        self.links = self._kinematics.links
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
        joints = self._urdf.joint_map
        rotary = [name for name in self.joint_names if joints[name].type in ROTARY]
        actuated = set(self.joint_names)
        return match_joints(
            recorded,
            self.joint_names,
            [str(name) for name in joints if name not in actuated],
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
        return self._kinematics.placed_by(joints)

    def joints_placing(self, link: str) -> frozenset[str]:
        """Joints whose positions must be known to place a link, as `links_placed_by` has it."""
        return self._kinematics.needed_by(link)

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
        return self._kinematics.poses(
            {name: positions.get(name, self._rest(name)) for name in self.joint_names}
        )

    @cached_property
    def parents(self) -> dict[str, str]:
        """{link: its parent link} of every link but the base."""
        return {str(joint.child): str(joint.parent) for joint in self._urdf.robot.joints}

    @cached_property
    def fixed_links(self) -> frozenset[str]:
        """Links fixed to their parent."""
        return frozenset(str(j.child) for j in self._urdf.robot.joints if j.type == "fixed")

    @cached_property
    def visual_meshes(self) -> "dict[str, trimesh.Trimesh]":
        """{link: one mesh in the link's frame, metres, coloured per vertex} of visible links.

        What cannot be used is left out, see `mesh_warnings`.
        """
        return self._meshes.of("visuals")

    @cached_property
    def visual_digest(self) -> str | None:
        """SHA-256 of all that `visual_meshes` depend on, known without reading the meshes.

        None where a file of theirs is missing, or is of a format whose files refer to others.
        """
        files = self._meshes.digest("visuals")
        return files and hashlib.sha256(f"{files} {self.text}".encode()).hexdigest()

    @cached_property
    def collision_meshes(self) -> "dict[str, trimesh.Trimesh]":
        """{link: one mesh in the link's frame, metres} of links with collision geometry.

        What cannot be used is left out, see `mesh_warnings`.
        """
        return self._meshes.of("collisions")

    @property
    def mesh_warnings(self) -> list[str]:
        """Messages about meshes that are left out; reading the meshes may add some."""
        return self._meshes.warnings

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


def load_robot(source: str | Path | None = None, mesh_folders: Sequence[str | Path] = ()) -> Robot:
    """Load a robot.

    Args:
        source: path of a URDF file; None is the Franka Emika Panda of the example-robot-data
            package. A string that starts with "<" is the URDF itself, as in /robot_description: its
            meshes come from packages and `mesh_folders` only.
        mesh_folders: further folders with its mesh files, or with packages of them.

    Raises:
        RobotError: the file does not exist or is not a URDF.
    """
    folders = tuple(Path(folder).absolute() for folder in mesh_folders)
    if isinstance(source, str) and source.lstrip().startswith("<"):
        return _robot(source, "The robot description", MeshPlaces(folders))
    path = panda_urdf_path() if source is None else Path(source)
    return _robot(_read(path), str(path), MeshPlaces(folders, path.parent))


def _read(path: Path) -> str:
    try:
        return read_file(path, _LARGEST, "URDF", RobotError).decode("utf-8-sig")
    except UnicodeDecodeError as error:
        raise RobotError(f"{path} is not a URDF: it is not a text file.") from error


@lru_cache(maxsize=16)
def _robot(text: str, where: str, places: MeshPlaces) -> Robot:
    # Recordings of the same robot share it, so that its meshes are loaded once.
    import yourdfpy

    root = _root(where, text)
    unknown = _remove_unknown_shapes(root)
    try:
        known = ElementTree.tostring(root) if unknown else text.encode("utf-8")
        with np.errstate(all="ignore"):  # numbers that are none show in the poses at rest
            urdf = yourdfpy.URDF.load(BytesIO(known), load_meshes=False, build_scene_graph=False)
            robot = Robot(urdf, str(urdf.robot.name), text, places, unknown)
            at_rest = np.stack(list(robot.link_poses({}).values()))
    except Exception as error:  # yourdfpy has no error type of its own
        raise RobotError(f"{where} is not a URDF that can be used: {error}.") from error
    if not (np.abs(at_rest) <= _FARTHEST).all():
        raise RobotError(f"{where} cannot be used: it puts links farther than {_FARTHEST:g} m.")
    return robot


def _root(where: str, text: str) -> ElementTree.Element:
    """Root of a description; RobotError where it is none."""
    # yourdfpy repairs broken XML silently and fails on the result.
    if len(text) > _LARGEST:
        raise RobotError(f"{where} has {len(text)} characters, more than {_LARGEST}.")
    try:
        root = ElementTree.fromstring(text.strip().encode("utf-8"))
    except ElementTree.ParseError as error:
        raise RobotError(f"{where} is not a URDF: {error}.") from error
    if root.tag != "robot" or not root.get("name"):
        raise RobotError(f"{where} is not a URDF: it must be a <robot> with a name.")
    if root.find("link") is None:
        raise RobotError(f"{where} has no links.")
    if (count := len(root.findall("link"))) > MOST_LINKS:
        raise RobotError(f"{where} has {count} links, more than {MOST_LINKS}.")
    if any(len(part.get("name", "")) > LONGEST_NAME for part in root):
        raise RobotError(f"{where} has names of more than {LONGEST_NAME} characters.")
    if any(not mesh.get("filename") for mesh in root.iter("mesh")):
        raise RobotError(f"{where} has a <mesh> without a filename.")
    return root


def _remove_unknown_shapes(root: ElementTree.Element) -> list[str]:
    """Remove shapes that a URDF cannot have, which yourdfpy fails on; returns their links."""
    links: list[str] = []
    for link in root.iter("link"):
        kept = [part for part in link if not _has_unknown_shape(part)]
        if len(kept) < len(link):
            links += [link.get("name", "")] * (len(link) - len(kept))
            link[:] = kept
    return links


def _has_unknown_shape(part: ElementTree.Element) -> bool:
    if part.tag not in ("visual", "collision"):
        return False
    shapes = [shape for geometry in part.findall("geometry") for shape in geometry]
    return len(shapes) != 1 or shapes[0].tag not in SHAPES
