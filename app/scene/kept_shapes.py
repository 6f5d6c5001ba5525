"""Parts of robots' shapes, kept among the user's caches: reading a robot's meshes takes seconds."""

import contextlib
import hashlib
import json
import logging
import zipfile
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from importlib.metadata import PackageNotFoundError, version
from io import BytesIO
from pathlib import Path
from typing import Any

import numpy as np
import platformdirs
from numpy.typing import NDArray

import robot_assets
from app.errors import InputError
from app.output.writing import write
from app.scene.colours import Colour
from robot_assets import Robot

_LOG = logging.getLogger(__name__)
_PACKAGES = ("numpy", "trimesh", "open3d", "open3d-cpu", "pycollada")


@dataclass(frozen=True)
class Part:
    """A mesh of one colour.

    Attributes:
        vertices: (V, 3) metres.
        faces: (F, 3) indices into the vertices.
        colour: red, green, blue, 0 to 255.
    """

    vertices: NDArray[np.float32]
    faces: NDArray[np.uint32]
    colour: Colour


Links = dict[str, tuple[Part, ...]]
"""{link: its parts in the link's frame}."""


def kept_parts(robot: Robot) -> Links | None:
    """The parts of a robot's visual meshes as they were kept, None where they were not."""
    path = _path(robot)
    if path is None:
        return None
    try:
        with np.load(path, allow_pickle=False) as file:
            about = json.loads(str(file["about"]))
            return {
                link: tuple(_part(file, *part) for part in parts) for link, parts in about.items()
            }
    except FileNotFoundError:
        return None
    except (OSError, EOFError, ValueError, KeyError, TypeError, zipfile.BadZipFile):
        _LOG.debug("%s cannot be read; the shape is made again.", path, exc_info=True)
        return None


def keep_parts(robot: Robot, links: Links) -> None:
    """Keep the parts of a robot's visual meshes, where the user's caches can be written."""
    path = _path(robot)
    if path is None or robot.mesh_warnings:
        return  # what is left out is found, and told, only where the meshes are read
    arrays: dict[str, NDArray[Any]] = {}
    about: dict[str, list[tuple[int, Colour]]] = {}
    for link, parts in links.items():
        about[link] = []
        for part in parts:
            number = len(arrays) // 2
            about[link].append((number, part.colour))
            arrays[f"vertices{number}"], arrays[f"faces{number}"] = part.vertices, part.faces
    content = BytesIO()
    arrays["about"] = np.array(json.dumps(about))
    np.savez(content, allow_pickle=False, **arrays)
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        write(path, content.getvalue())
    except (OSError, InputError):
        _LOG.debug("%s cannot be written; the shape is not kept.", path, exc_info=True)


def _part(file: Mapping[str, NDArray[Any]], number: int, colour: Sequence[int]) -> Part:
    red, green, blue = map(int, colour)
    return Part(file[f"vertices{number}"], file[f"faces{number}"], (red, green, blue))


def _path(robot: Robot) -> Path | None:
    """Where a robot's parts are kept, by all that they depend on; None where that is not known."""
    if robot.visual_digest is None:
        return None
    digest = hashlib.sha256(robot.visual_digest.encode())
    # Both this code and that which reads the meshes may change.
    for folder in (Path(__file__).parent, Path(robot_assets.__file__).parent):
        for source in sorted(folder.glob("*.py")):
            digest.update(source.read_bytes())
    for package in _PACKAGES:
        with contextlib.suppress(PackageNotFoundError):
            digest.update(f"{package} {version(package)} ".encode())
    return platformdirs.user_cache_path("tofscope") / "shapes" / f"{digest.hexdigest()[:32]}.npz"
