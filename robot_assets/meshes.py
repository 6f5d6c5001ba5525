"""Meshes of a robot's links; what cannot be used is left out and told."""

import hashlib
from collections.abc import Iterator, Sequence
from functools import lru_cache
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal

import numpy as np
from numpy.typing import NDArray

from robot_assets.mesh_files import LARGEST_FILE, MeshError, MeshPlaces, read_mesh

if TYPE_CHECKING:
    import trimesh
    import yourdfpy

MOST_TRIANGLES = 400_000
"""Triangles of a robot's visual meshes, and as many of its collision meshes."""
SHAPES = ("box", "cylinder", "sphere", "mesh")
"""Shapes of a URDF."""
MOST_SHAPES = 2000
"""Meshes and shapes of a robot that are visible, and as many for collisions."""
MOST_BYTES = 64 * 2**20
"""Bytes of a robot's mesh files in all, each counted once."""
_SPHERE = 1280
"""Triangles of a sphere, the simple shape with the most."""
_FARTHEST = 1e4
"""Metres from its link's origin that a shape may reach."""
_EFFECT = "what it shows is neither drawn nor removed from the clouds"

_ALONE = (".stl", ".dae", ".ply", ".glb")
"""Formats whose files hold all of a mesh, but pictures of surfaces that are not shown."""

Kind = Literal["visuals", "collisions"]


class RobotMeshes:
    """Meshes of the links of a robot, read when they are asked for.

    Args:
        urdf: a loaded description.
        places: where its mesh files may lie.
        unknown: links with shapes that the description lost because they are of no known kind.
    """

    def __init__(
        self, urdf: "yourdfpy.URDF", places: MeshPlaces, unknown: Sequence[str] = ()
    ) -> None:
        self._urdf = urdf
        self._places = places
        self._files: dict[Path, trimesh.Trimesh | MeshError] = {}
        self._bytes_left = MOST_BYTES
        # Keys end with what tells shapes of one link apart; a mesh counts once, however often used.
        self._left_out = {
            (_shape_of(link), f"unknown {i}"): f"it is none of {', '.join(SHAPES)}"
            for i, link in enumerate(unknown)
        }
        parts = [part for _, part in self._parts("visuals", "collisions")]
        meshes = [mesh for part in parts if (mesh := getattr(part.geometry, "mesh", None))]
        for name in list(dict.fromkeys(str(mesh.filename) for mesh in meshes))[:MOST_SHAPES]:
            self._look_up(name)

    def of(self, kind: Kind) -> "dict[str, trimesh.Trimesh]":
        """{link: one mesh in the link's frame, metres, coloured per vertex}.

        Shapes that cannot be used are left out, see `warnings`.
        """
        import trimesh

        found: dict[str, list[trimesh.Trimesh]] = {}
        left = MOST_TRIANGLES
        for number, (link, part) in enumerate(self._parts(kind)):
            try:
                if number >= MOST_SHAPES:
                    raise MeshError(f"the robot has more than {MOST_SHAPES} shapes")
                mesh = self._mesh(part, left)
            except MeshError as error:
                mesh = getattr(part.geometry, "mesh", None)
                shape = (_shape_of(link), f"{kind} {number}")
                self._left_out[(mesh.filename, "") if mesh else shape] = str(error)
            else:
                left -= len(mesh.faces)
                found.setdefault(link, []).append(mesh)
        return {link: trimesh.util.concatenate(parts) for link, parts in found.items()}  # type: ignore[misc]

    def digest(self, kind: Kind) -> str | None:
        """SHA-256 of the files that `of` reads; None where one is missing, or refers to others."""
        digest = hashlib.sha256()
        meshes = [getattr(part.geometry, "mesh", None) for _, part in self._parts(kind)]
        try:
            for name in dict.fromkeys(str(mesh.filename) for mesh in meshes if mesh):
                path = self._places.find(name)
                if path.suffix.lower() not in _ALONE or path.stat().st_size > LARGEST_FILE:
                    return None
                digest.update(path.read_bytes())
        except (MeshError, OSError):
            return None
        return digest.hexdigest()

    @property
    def warnings(self) -> list[str]:
        """A sentence for each reason why meshes or shapes are left out."""
        by_reason: dict[str, list[str]] = {}
        for (name, _), reason in list(self._left_out.items()):
            by_reason.setdefault(reason, []).append(name)
        robot = self._urdf.robot.name
        return [
            f"A mesh or shape of {robot} is left out, {names[0]}: {reason}; {_EFFECT}."
            if len(names) == 1
            else f"{len(names)} meshes or shapes of {robot} are left out, such as {names[0]}: "
            f"{reason}; {_EFFECT}."
            for reason, names in by_reason.items()
        ]

    def _parts(self, *kinds: Kind) -> Iterator[tuple[str, Any]]:
        for name, link in self._urdf.link_map.items():
            for kind in kinds:
                for part in getattr(link, kind):
                    yield str(name), part

    def _look_up(self, filename: str) -> None:
        try:
            self._places.find(filename)
        except MeshError as error:
            self._left_out[filename, ""] = str(error)

    def _mesh(self, part: Any, most: int) -> "trimesh.Trimesh":  # noqa: ANN401 (untyped)
        """Mesh of a part in its link's frame; MeshError where it cannot be used."""
        geometry = part.geometry
        if getattr(geometry, "mesh", None) is not None:
            mesh = self._read(self._places.find(geometry.mesh.filename))
            if len(mesh.faces) > most:
                raise MeshError(f"it has {len(mesh.faces)} triangles, and {most} are left for it")
            if geometry.mesh.scale is not None:
                mesh.apply_scale(_numbers(geometry.mesh.scale, "scale", 3, signed=True))
        else:
            if most < _SPHERE:
                raise MeshError(f"the robot has more than {MOST_TRIANGLES} triangles")
            mesh = _shape(geometry)
        if part.origin is not None:
            with np.errstate(all="ignore"):  # judged by its result
                mesh.apply_transform(part.origin)
        if not (np.abs(mesh.vertices) <= _FARTHEST).all():
            raise MeshError(f"it reaches farther than {_FARTHEST:g} m from its link")
        return mesh

    def _read(self, path: Path) -> "trimesh.Trimesh":
        """A copy of a file's mesh; each file is read once, and MeshError is raised as often."""
        if path not in self._files:
            try:
                self._bytes_left -= path.stat().st_size
                if self._bytes_left < 0:
                    raise MeshError(f"the robot's mesh files have more than {MOST_BYTES} bytes")
                self._files[path] = read_mesh(path)
            except MeshError as error:
                self._files[path] = error
            except OSError as error:
                self._files[path] = MeshError(f"it cannot be read ({error.strerror})")
        found = self._files[path]
        if isinstance(found, MeshError):
            raise found
        return found.copy()


def _shape(geometry: Any) -> "trimesh.Trimesh":  # noqa: ANN401
    import trimesh

    if geometry.box is not None:
        return trimesh.creation.box(extents=_numbers(geometry.box.size, "size", 3))
    if geometry.cylinder is not None:
        cylinder = geometry.cylinder
        size = _numbers([cylinder.radius, cylinder.length], "radius and length", 2)
        return trimesh.creation.cylinder(radius=size[0], height=size[1])
    if geometry.sphere is not None:
        size = _numbers([geometry.sphere.radius], "radius", 1)
        return _sphere(float(size[0])).copy()
    raise MeshError(f"it is none of {', '.join(SHAPES)}")


@lru_cache(maxsize=8)
def _sphere(radius: float) -> "trimesh.Trimesh":
    import trimesh

    return trimesh.creation.icosphere(radius=radius)


def _numbers(
    values: Any,  # noqa: ANN401
    what: str,
    count: int,
    signed: bool = False,
) -> NDArray[np.float64]:
    """Sizes of a shape, or a mesh's scale; MeshError where they are none."""
    given = [] if values is None else [np.nan if v is None else v for v in np.ravel(values)]
    numbers = np.array(given, dtype=np.float64)
    if signed and len(numbers) == 1:
        numbers = np.repeat(numbers, count)
    large = np.abs(numbers) if signed else numbers
    if len(numbers) != count or not ((large > 0) & (large <= _FARTHEST)).all():
        text = " ".join(f"{number:g}" for number in numbers[:4]) or "nothing"
        raise MeshError(f"its {what} cannot be {text}")
    return numbers


def _shape_of(link: str) -> str:
    return f"a shape of link {link}"
