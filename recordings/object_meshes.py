"""Meshes of a simulation's moving objects: an attachment of our own recordings."""

import io
import zipfile
import zlib
from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType

import numpy as np
from numpy.typing import NDArray

from recordings.cloud import read_only
from recordings.mcap_file import McapFile
from recordings.transforms import TransformTree
from robot_assets import Transform

OBJECT_MESHES = "object_meshes.npz"
"""Name of the attachment: per object's frame in /tf the arrays `<frame>.vertices` and `.faces`."""
MESHES_TYPE = "application/x-npz"
MOST_OBJECTS = 64
MOST_OBJECT_TRIANGLES = 200_000
_LARGEST = 8 * 2**20  # bytes of all arrays: as many triangles, with a vertex each
_FARTHEST = 1e3  # metres of a vertex from its object's origin
_BROKEN = (OSError, ValueError, EOFError, KeyError, RuntimeError, zlib.error, zipfile.BadZipFile)
_HEADER = 256  # bytes at most of the header of one array


@dataclass(frozen=True)
class ObjectMesh:
    """Surface of a rigid object in its own frame.

    Attributes:
        vertices: (V, 3) metres.
        faces: (F, 3) indices into the vertices.
    """

    vertices: NDArray[np.float32]
    faces: NDArray[np.uint32]


class TrueObjects:
    """Surfaces of the moving objects, and where they truly are.

    Args:
        meshes: {frame: mesh in it}.
        tree: poses of /tf.
        fixed_frame: of the poses.

    Attributes:
        meshes: of the objects whose pose is known.
    """

    def __init__(
        self, meshes: Mapping[str, ObjectMesh], tree: TransformTree, fixed_frame: str
    ) -> None:
        placed = {f: m for f, m in meshes.items() if tree.connected(fixed_frame, f)}
        self.meshes: Mapping[str, ObjectMesh] = MappingProxyType(placed)
        self._tree, self._fixed_frame = tree, fixed_frame

    def poses(self, k: int) -> dict[str, Transform]:
        """{frame: T_fixed_object (4, 4)} at frame `k`, NaN where unknown."""
        return {frame: self._tree.transform(self._fixed_frame, frame, k) for frame in self.meshes}


def pack_meshes(meshes: Mapping[str, ObjectMesh]) -> bytes:
    """Content of the attachment, of {frame: mesh}."""
    arrays: dict[str, NDArray[np.float32] | NDArray[np.uint32]] = {}
    for frame, mesh in meshes.items():
        arrays[f"{frame}.vertices"] = mesh.vertices.astype(np.float32)
        arrays[f"{frame}.faces"] = mesh.faces.astype(np.uint32)
    buffer = io.BytesIO()
    np.savez_compressed(buffer, **arrays)  # type: ignore[arg-type]
    return buffer.getvalue()


def object_meshes(file: McapFile) -> tuple[dict[str, ObjectMesh], list[str]]:
    """{frame: mesh} of the moving objects, and a warning where the file's cannot be used."""
    content = file.attachment(OBJECT_MESHES)
    if content is None:
        return {}, []
    try:
        return _unpacked(content), []
    except _UnusableError as error:
        return {}, [f"The file's meshes of its moving objects are not used: {error}."]


class _UnusableError(Exception):
    """The attachment cannot be used; the text is the reason."""


def _unpacked(content: bytes) -> dict[str, ObjectMesh]:
    arrays = _arrays(content)
    frames = list(dict.fromkeys(name.rpartition(".")[0] for name in arrays))
    meshes = {frame: _mesh(frame, arrays) for frame in frames}
    triangles = sum(len(mesh.faces) for mesh in meshes.values())
    if triangles > MOST_OBJECT_TRIANGLES:
        raise _UnusableError(f"they have {triangles} triangles, more than {MOST_OBJECT_TRIANGLES}")
    return meshes


def _arrays(content: bytes) -> dict[str, NDArray[np.float32 | np.uint32]]:
    try:
        with zipfile.ZipFile(io.BytesIO(content)) as archive:
            members = archive.infolist()
            if len(members) > 2 * MOST_OBJECTS:
                raise _UnusableError(f"there are more than {MOST_OBJECTS}")
            if sum(member.file_size for member in members) > _LARGEST + _HEADER * len(members):
                raise _UnusableError(f"they have more than {_LARGEST} bytes")
            return {
                member.filename.removesuffix(".npy"): _table(archive.read(member))
                for member in members
            }
    except _BROKEN as error:
        raise _UnusableError("they cannot be read") from error


def _table(content: bytes) -> NDArray[np.float32 | np.uint32]:
    """Table (N, 3) of a NumPy file; ValueError unless it holds one of our two types and no more."""
    stream = io.BytesIO(content)
    if np.lib.format.read_magic(stream) != (1, 0):
        raise ValueError("another version")
    shape, by_columns, kind = np.lib.format.read_array_header_1_0(stream)
    values = content[stream.tell() :]
    if by_columns or len(shape) != 2 or shape[1] != 3 or kind not in (np.float32, np.uint32):
        raise ValueError("no table of ours")
    if len(values) != 12 * shape[0]:
        raise ValueError("not as long as it says")
    of = np.float32 if kind == np.float32 else np.uint32
    return np.frombuffer(values, dtype=of).reshape(-1, 3)


def _mesh(frame: str, arrays: Mapping[str, NDArray[np.float32 | np.uint32]]) -> ObjectMesh:
    vertices, faces = arrays.get(f"{frame}.vertices"), arrays.get(f"{frame}.faces")
    if vertices is None or faces is None or len(faces) == 0:
        raise _UnusableError("one has no vertices or no faces")
    if vertices.dtype != np.float32 or faces.dtype != np.uint32:
        raise _UnusableError("one has numbers of another type")
    if not (np.abs(vertices) <= _FARTHEST).all():
        raise _UnusableError(f"a vertex is farther than {_FARTHEST:g} m from its object")
    if faces.max() >= len(vertices):
        raise _UnusableError("a face has a vertex that is not there")
    return ObjectMesh(read_only(vertices.astype(np.float32)), read_only(faces.astype(np.uint32)))
