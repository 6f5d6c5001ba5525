"""Meshes of a robot: paths of a URDF's mesh files, and reading them."""

from pathlib import Path
from typing import Any

import numpy as np
import trimesh
import yourdfpy

from robot_assets.errors import RobotError

_EXAMPLE_ROBOT_DATA = "package://example-robot-data/"


def link_meshes(urdf: yourdfpy.URDF, kind: str) -> dict[str, trimesh.Trimesh]:
    """{link: one mesh in the link's frame, metres, coloured per vertex}.

    Args:
        urdf: a loaded description.
        kind: "visuals" or "collisions".

    Raises:
        RobotError: a mesh file that is there cannot be read.
    """
    meshes: dict[str, trimesh.Trimesh] = {}
    for name, link in urdf.link_map.items():
        parts = [_part_mesh(part, urdf) for part in getattr(link, kind)]
        parts = [part for part in parts if part is not None]
        if parts:
            meshes[str(name)] = trimesh.util.concatenate(parts)  # type: ignore[assignment]
    return meshes


def panda_urdf_path() -> Path:
    """Path of the Panda's URDF in the example-robot-data package."""
    return _example_robot_data() / "robots" / "panda_description" / "urdf" / "panda.urdf"


def resolve_mesh(name: str, folder: Path | None = None) -> str:
    """Path of a mesh named in a URDF; the name itself where no such file is found."""
    if name.startswith(_EXAMPLE_ROBOT_DATA):
        return str(_example_robot_data() / name.removeprefix(_EXAMPLE_ROBOT_DATA))
    if name.startswith("package://") and folder is not None:
        # A ROS package keeps its meshes beside its urdf folder.
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
    # The package is a data wheel without a module to import.
    from importlib.metadata import distribution

    share = distribution("example-robot-data").locate_file("cmeel.prefix/share/example-robot-data")
    return Path(str(share))


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
    except Exception as error:  # trimesh passes on errors of each format's reader
        raise RobotError(f"The mesh {path} cannot be read: {error}.") from error
    if len(mesh.faces) == 0:
        raise RobotError(f"The mesh {path} has no triangles.")
    return mesh


def _coloured(loaded: Any) -> trimesh.Trimesh:  # noqa: ANN401 (trimesh.load gives a mesh or a scene)
    """Merge a loaded file into one mesh, with materials as vertex colours."""
    parts: list[trimesh.Trimesh] = []
    for mesh in [loaded] if isinstance(loaded, trimesh.Trimesh) else loaded.dump():
        material: Any = getattr(mesh.visual, "material", mesh.visual)
        colours = np.tile(material.main_color, (len(mesh.vertices), 1))
        parts.append(
            trimesh.Trimesh(mesh.vertices, mesh.faces, vertex_colors=colours, process=False)
        )
    return trimesh.util.concatenate(parts)  # type: ignore[return-value]
