import io
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from recordings.object_meshes import (
    MOST_OBJECT_TRIANGLES,
    OBJECT_MESHES,
    ObjectMesh,
    TrueObjects,
    object_meshes,
    pack_meshes,
)
from recordings.transforms import TransformTree
from tests.recordings.foreign import at

CORNERS = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], np.float32)
SIDES = np.array([[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]], np.uint32)
TETRAHEDRON = ObjectMesh(CORNERS, SIDES)


def file(content: bytes | None) -> Any:
    return SimpleNamespace(attachment={}.get if content is None else {OBJECT_MESHES: content}.get)


def archive(**arrays: np.ndarray) -> bytes:
    buffer = io.BytesIO()
    np.savez_compressed(buffer, **arrays)  # type: ignore[arg-type]
    return buffer.getvalue()


def test_meshes_come_back_from_their_attachment():
    packed = pack_meshes({"target": TETRAHEDRON, "object_32": TETRAHEDRON})
    meshes, warnings = object_meshes(file(packed))
    assert warnings == []
    assert list(meshes) == ["target", "object_32"]
    for mesh in meshes.values():
        np.testing.assert_array_equal(mesh.vertices, CORNERS)
        np.testing.assert_array_equal(mesh.faces, SIDES)
        assert not mesh.vertices.flags.writeable


def test_files_without_them_have_none():
    assert object_meshes(file(None)) == ({}, [])


def of(vertices: Any = CORNERS, faces: Any = SIDES) -> bytes:
    return archive(**{"target.vertices": vertices, "target.faces": faces})


@pytest.mark.parametrize(
    "content",
    [
        b"",
        b"nonsense",
        b"PK\x03\x04" + bytes(40),
        pack_meshes({"target": TETRAHEDRON})[:200],
        archive(vertices=CORNERS),
        archive(**{"target.faces": SIDES}),
        of(faces=SIDES[:0]),
        of(faces=SIDES + 1),
        of(faces=SIDES.astype(np.int64)),
        of(faces=SIDES.astype(np.float32)),
        of(faces=np.asfortranarray(SIDES)),
        of(vertices=CORNERS[:, :2]),
        of(vertices=CORNERS * np.float32(np.nan)),
        of(vertices=CORNERS * np.float32(2e3)),
        of(vertices=np.zeros((10**6, 3), np.float32)),
        of(faces=np.zeros((MOST_OBJECT_TRIANGLES + 1, 3), np.uint32)),
        archive(
            **{f"object_{i}.{part}": SIDES for i in range(65) for part in ("vertices", "faces")}
        ),
    ],
)
def test_anything_else_is_told_and_not_used(content: bytes):
    meshes, (warning,) = object_meshes(file(content))
    assert meshes == {}
    assert warning.startswith("The file's meshes of its moving objects are not used: ")


def test_an_object_is_where_its_frame_is():
    moving = np.stack([at(y=0.1 * k) for k in range(5)])
    tree = TransformTree({"target": "base"}, {"target": moving})
    objects = TrueObjects({"target": TETRAHEDRON, "elsewhere": TETRAHEDRON}, tree, "base")
    assert list(objects.meshes) == ["target"]
    np.testing.assert_allclose(objects.poses(3)["target"], at(y=0.3))
