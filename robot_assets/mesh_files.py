"""Mesh files of a robot: where they may come from, and reading them."""

import os
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from importlib.metadata import distribution
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    import trimesh

FORMATS = (".stl", ".dae", ".obj", ".ply", ".glb", ".gltf")
"""Endings of the files that are read: formats of one mesh or scene, and no archives."""
LARGEST_FILE = 32 * 2**20
"""Bytes of a mesh file."""
LARGEST_TEXT = 16 * 2**20
"""Bytes of a mesh file in a format of text, which takes thirty times as much while it is read."""
_TEXT = (".dae", ".obj", ".gltf")
_SAID = 200  # characters of a reader's error
_PACKAGE, _FILE = "package://", "file://"
_EXAMPLE_DATA = "example-robot-data"


class MeshError(Exception):
    """Mesh or shape that cannot be used; the text is a reason, such as "it has no triangles"."""


@dataclass(frozen=True)
class MeshPlaces:
    """Where the mesh files of a robot may lie.

    Links in packages and folders are followed: who made them is the user. Packages are found by
    their names: example-robot-data, and those of a sourced ROS environment
    (AMENT_PREFIX_PATH, ROS_PACKAGE_PATH).

    Attributes:
        folders: that the user named, for packages and for other names.
        described_in: folder of the description where that is a file that the user named, which may
            then name any file; None for the description in a recording, which may not.
    """

    folders: tuple[Path, ...] = ()
    described_in: Path | None = None

    def find(self, name: str) -> Path:
        """Find the file that a description names.

        Raises:
            MeshError: it is in none of the places.
        """
        if "://" in name and not name.startswith((_PACKAGE, _FILE)):
            raise MeshError("it is neither a file nor in a package")
        goes_up = ".." in Path(name).parts
        for root, path in self._candidates(name):
            inside = root is None or (path.is_relative_to(root) and not goes_up)
            if inside and _is_file(path):
                return path
        # Whether there is such a file elsewhere on this machine is not said.
        raise MeshError("it is not found; --meshes names folders to look in")

    def _candidates(self, name: str) -> Iterator[tuple[Path | None, Path]]:
        """(folder that the file must lie in, None for any; path) in order of preference."""
        if name.startswith(_PACKAGE):
            package, _, inside = name.removeprefix(_PACKAGE).partition("/")
            for folder in self.folders:
                yield folder, folder / package / inside
                yield folder, folder / inside
            for root in _packages(package):
                yield root, root / inside
            if self.described_in is not None:
                # A ROS package keeps its meshes beside its urdf folder.
                for above in (self.described_in, *self.described_in.parents):
                    yield None, above / package / inside
                    yield None, above / inside
            return
        path = Path(name.removeprefix(_FILE))
        if self.described_in is not None:
            yield None, self.described_in / path
        for folder in self.folders:
            yield folder, folder / path
        if path.is_absolute():
            for root in (_example_data(), *_ros_folders()):
                yield root, path


def panda_urdf_path() -> Path:
    """Path of the Panda's URDF in the example-robot-data package."""
    return _example_data() / "robots" / "panda_description" / "urdf" / "panda.urdf"


def read_mesh(path: Path) -> "trimesh.Trimesh":
    """Read a mesh file as one mesh, metres, materials as colours of its vertices.

    Args:
        path: a file of one of the `FORMATS`.

    Raises:
        MeshError: it cannot be read, is too large, or is empty.
    """
    import trimesh

    if path.suffix.lower() not in FORMATS:
        raise MeshError(f"its format is none of {', '.join(FORMATS)}")
    try:
        most = LARGEST_TEXT if path.suffix.lower() in _TEXT else LARGEST_FILE
        if (size := path.stat().st_size) > most:
            raise MeshError(f"it has {size} bytes, more than {most}")
        mesh = _coloured(trimesh.load(path))
    except MeshError:
        raise
    except Exception as error:  # trimesh passes on errors of each format's reader
        said = " ".join(str(error).split())[:_SAID].rstrip(".") or type(error).__name__
        raise MeshError(f"it cannot be read ({said})") from error
    if len(mesh.faces) == 0:
        raise MeshError("it has no triangles")
    return mesh


def _coloured(loaded: Any) -> "trimesh.Trimesh":  # noqa: ANN401 (trimesh.load gives a mesh or a scene)
    """Merge a loaded file into one mesh, with materials as vertex colours."""
    import trimesh

    parts: list[trimesh.Trimesh] = []
    for mesh in [loaded] if isinstance(loaded, trimesh.Trimesh) else loaded.dump():
        material: Any = getattr(mesh.visual, "material", mesh.visual)
        colours = np.tile(material.main_color, (len(mesh.vertices), 1))
        parts.append(
            trimesh.Trimesh(mesh.vertices, mesh.faces, vertex_colors=colours, process=False)
        )
    return trimesh.util.concatenate(parts)  # type: ignore[return-value]


def _packages(name: str) -> Sequence[Path]:
    """Folders of the packages of this name."""
    if name == _EXAMPLE_DATA:
        return [_example_data()]
    if name in ("", ".", ".."):
        return []
    return [folder if folder.name == name else folder / name for folder in _ros_folders()]


def _ros_folders() -> list[Path]:
    """Folders of packages of the sourced ROS environment."""
    prefixes = os.environ.get("AMENT_PREFIX_PATH", "").split(os.pathsep)
    others = os.environ.get("ROS_PACKAGE_PATH", "").split(os.pathsep)
    return [*(Path(p) / "share" for p in prefixes if p), *(Path(p) for p in others if p)]


def _example_data() -> Path:
    # The package is a data wheel without a module to import.
    share = distribution(_EXAMPLE_DATA).locate_file(f"cmeel.prefix/share/{_EXAMPLE_DATA}")
    return Path(str(share))


def _is_file(path: Path) -> bool:
    try:
        return path.is_file()
    except (OSError, ValueError):  # a name that is too long, or no name of a file
        return False
