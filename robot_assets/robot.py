"""A robot: its links, joints, meshes, and where its links are for given joint positions."""

import re
import threading
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from functools import cached_property, lru_cache
from io import BytesIO
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import numpy as np
import trimesh
import yourdfpy
from numpy.typing import NDArray

Transform = NDArray[np.float64]
_EXAMPLE_ROBOT_DATA = "package://example-robot-data/"


class RobotError(Exception):
    """A robot description that cannot be used."""


@dataclass(frozen=True)
class JointMatch:
    """How a set of recorded joint names fits a robot.

    Attributes:
        joints: {recorded name: the robot's joint}.
        missing: the robot's actuated joints that no recorded name fits, in the robot's order.
        ambiguous: the robot's joints that several recorded names fit; they match none of them.
    """

    joints: dict[str, str]
    missing: tuple[str, ...]
    ambiguous: tuple[str, ...]


class Robot:
    """A robot from a URDF.

    Args:
        urdf: a loaded description; `load_robot` makes one from a file or a text.
        name: what to call it on screen.
        text: the description as it was given.
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
        """Match recorded joint names to this robot's, exactly or by what follows the prefix.

        `panda_joint1`, `fer_joint1`, `fr3_joint1` and `/left/panda_joint1` all mean the joint
        whose name without the robot's own prefix is `joint1`.
        """
        cores = {name: name.removeprefix(self._prefix) for name in self.joint_names}
        candidates: dict[str, list[str]] = {name: [] for name in self.joint_names}
        for recorded_name in recorded:
            fitting = [n for n, core in cores.items() if _ends_with(recorded_name, core)]
            if fitting:
                candidates[max(fitting, key=lambda n: len(cores[n]))].append(recorded_name)
        exact = {n: [n] for n, names in candidates.items() if n in names}
        candidates |= exact
        return JointMatch(
            joints={names[0]: n for n, names in candidates.items() if len(names) == 1},
            missing=tuple(n for n, names in candidates.items() if not names),
            ambiguous=tuple(n for n, names in candidates.items() if len(names) > 1),
        )

    def outside_limits(self, positions: Mapping[str, float], tolerance: float = 1e-3) -> list[str]:
        """Say, in a sentence each, which joints are beyond their limits by over `tolerance`."""
        return [
            f"{name} is at {positions[name]:.3f}, outside its limits {low:.3f} to {high:.3f}."
            for name, (low, high) in self.joint_limits.items()
            if name in positions and not low - tolerance <= positions[name] <= high + tolerance
        ]

    def link_poses(self, positions: Mapping[str, float]) -> dict[str, Transform]:
        """Forward kinematics.

        Args:
            positions: {joint: rad or m}; joints not given stand at 0, or at the limit nearest to 0.

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
        """{link: the link that its joint hangs on} of every link but the base."""
        return {str(joint.child): str(joint.parent) for joint in self._urdf.robot.joints}

    @cached_property
    def fixed_links(self) -> frozenset[str]:
        """Links that never move relative to their parent."""
        return frozenset(str(j.child) for j in self._urdf.robot.joints if j.type == "fixed")

    @cached_property
    def visual_meshes(self) -> dict[str, trimesh.Trimesh]:
        """{link: one mesh in the link's frame, metres, coloured per vertex} of links that show.

        Meshes that are not there are left out, see `missing_meshes`; a broken one is a RobotError.
        """
        return self._meshes("visuals")

    @cached_property
    def collision_meshes(self) -> dict[str, trimesh.Trimesh]:
        """{link: one mesh in the link's frame, metres} of links that have a body.

        Meshes that are not there are left out, see `missing_meshes`; a broken one is a RobotError.
        """
        return self._meshes("collisions")

    @cached_property
    def missing_meshes(self) -> tuple[str, ...]:
        """Mesh files that the description names and that could not be found."""
        return tuple(
            geometry.mesh.filename
            for link in self._urdf.link_map.values()
            for part in [*link.visuals, *link.collisions]
            if (geometry := part.geometry).mesh is not None
            and not Path(self._urdf._filename_handler(geometry.mesh.filename)).is_file()
        )

    @cached_property
    def _prefix(self) -> str:
        # What is left must still say that it is a joint: "joint_" is no robot's name.
        if not all("joint" in name.partition("_")[2] for name in self.joint_names):
            return ""
        heads = {re.match(r"^[A-Za-z0-9]+_", name) for name in self.joint_names}
        texts = {head.group() if head else "" for head in heads}
        return texts.pop() if len(texts) == 1 else ""

    def _rest(self, joint: str) -> float:
        low, high = self.joint_limits.get(joint, (-np.inf, np.inf))
        return float(np.clip(0.0, low, high))

    def _meshes(self, kind: str) -> dict[str, trimesh.Trimesh]:
        meshes: dict[str, trimesh.Trimesh] = {}
        for name, link in self._urdf.link_map.items():
            parts = [_part_mesh(part, self._urdf) for part in getattr(link, kind)]
            parts = [part for part in parts if part is not None]
            if parts:
                meshes[str(name)] = trimesh.util.concatenate(parts)  # type: ignore[assignment]
        return meshes


def load_robot(source: str | Path | None = None) -> Robot:
    """Load a robot.

    Args:
        source: path of a URDF file; None is the Franka Emika Panda of the example-robot-data
            package. A string that starts with "<" is a URDF itself, as in /robot_description.

    Raises:
        RobotError: the file is not there, or not a URDF.
    """
    if isinstance(source, str) and source.lstrip().startswith("<"):
        where, text, folder = "The robot description", source, None
    else:
        path = panda_urdf_path() if source is None else Path(source)
        where, folder = str(path), path.parent
        try:
            text = path.read_text(encoding="utf-8")
        except OSError as error:
            raise RobotError(f"{path} cannot be read as a URDF file: {error.strerror}.") from error
        except UnicodeDecodeError as error:
            raise RobotError(f"{path} is not a URDF: it is not a text file.") from error
    return _robot(text, where, folder)


@lru_cache(maxsize=16)
def _robot(text: str, where: str, folder: Path | None) -> Robot:
    # Recordings of the same robot share it, and with it the meshes that are loaded once.
    _check_is_urdf(where, text)
    try:
        urdf = yourdfpy.URDF.load(
            BytesIO(text.encode("utf-8")),
            filename_handler=lambda name: resolve_mesh(name, folder),
            load_meshes=False,
            build_scene_graph=True,
        )
        robot = Robot(urdf, str(urdf.robot.name), text)
        robot.link_poses({})  # joints that form a loop are found out only here
    except Exception as error:  # yourdfpy raises whatever its parser or its maths meets
        raise RobotError(f"{where} is not a URDF that can be used: {error}.") from error
    return robot


def _check_is_urdf(where: str, text: str) -> None:
    # yourdfpy repairs broken XML silently, and then fails on what it made of it.
    try:
        root = ElementTree.fromstring(text.strip().encode("utf-8"))
    except ElementTree.ParseError as error:
        raise RobotError(f"{where} is not a URDF: {error}.") from error
    if root.tag != "robot" or not root.get("name"):
        raise RobotError(f"{where} is not a URDF: it must be a <robot> with a name.")
    if root.find("link") is None:
        raise RobotError(f"{where} has no links.")


def panda_urdf_path() -> Path:
    """Where the example-robot-data package keeps the Panda's URDF."""
    return _example_robot_data() / "robots" / "panda_description" / "urdf" / "panda.urdf"


def resolve_mesh(name: str, folder: Path | None = None) -> str:
    """Turn a mesh's name in a URDF into a path; a name that leads nowhere is returned as it is."""
    if name.startswith(_EXAMPLE_ROBOT_DATA):
        return str(_example_robot_data() / name.removeprefix(_EXAMPLE_ROBOT_DATA))
    if name.startswith("package://") and folder is not None:
        # A package's meshes lie beside its urdf folder: look for them from there upwards.
        inside = name.removeprefix("package://")
        below = inside.split("/", 1)[-1]
        for parent in [folder, *folder.parents]:
            for candidate in (parent / inside, parent / below):
                if candidate.is_file():
                    return str(candidate)
    if folder is not None and (folder / name.removeprefix("file://")).is_file():
        return str(folder / name.removeprefix("file://"))
    return name.removeprefix("file://")


def _example_robot_data() -> Path:
    # The package is a bare data wheel: it has no module to ask, only this place in site-packages.
    from importlib.metadata import distribution

    share = distribution("example-robot-data").locate_file("cmeel.prefix/share/example-robot-data")
    return Path(str(share))


def _ends_with(recorded: str, core: str) -> bool:
    return recorded == core or recorded.endswith((f"_{core}", f"/{core}"))


def _part_mesh(part: Any, urdf: yourdfpy.URDF) -> trimesh.Trimesh | None:  # noqa: ANN401 (untyped)
    geometry = part.geometry
    if geometry.box is not None:
        mesh = trimesh.creation.box(extents=geometry.box.size)
    elif geometry.cylinder is not None:
        mesh = trimesh.creation.cylinder(
            radius=geometry.cylinder.radius, height=geometry.cylinder.length
        )
    elif geometry.sphere is not None:
        mesh = trimesh.creation.icosphere(radius=geometry.sphere.radius)
    else:
        path = Path(urdf._filename_handler(geometry.mesh.filename))
        if not path.is_file():
            return None
        mesh = _read_mesh(path)
        if geometry.mesh.scale is not None:
            mesh.apply_scale(geometry.mesh.scale)
    if part.origin is not None:
        mesh.apply_transform(part.origin)
    return mesh


def _read_mesh(path: Path) -> trimesh.Trimesh:
    try:
        mesh = _coloured(trimesh.load(path))
    except Exception as error:  # trimesh raises whatever the reader of that format meets
        raise RobotError(f"The mesh {path} cannot be read: {error}.") from error
    if len(mesh.faces) == 0:
        raise RobotError(f"The mesh {path} has no triangles.")
    return mesh


def _coloured(loaded: Any) -> trimesh.Trimesh:  # noqa: ANN401 (trimesh.load gives a mesh or a scene)
    """Flatten a loaded file into one mesh whose materials have become vertex colours."""
    parts: list[trimesh.Trimesh] = []
    for mesh in [loaded] if isinstance(loaded, trimesh.Trimesh) else loaded.dump():
        material: Any = getattr(mesh.visual, "material", mesh.visual)
        colours = np.tile(material.main_color, (len(mesh.vertices), 1))
        parts.append(
            trimesh.Trimesh(mesh.vertices, mesh.faces, vertex_colors=colours, process=False)
        )
    return trimesh.util.concatenate(parts)  # type: ignore[return-value]
