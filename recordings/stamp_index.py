"""Attachment with the header stamps of all messages, so that opening a file reads no message."""

import io
import zipfile
import zlib
from collections.abc import Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

STAMP_INDEX = "header_stamps.npz"
MEDIA_TYPE = "application/x-npz"
_HEADER = 256
"""Bytes at most of the header of one array."""


def pack(stamps: Mapping[str, Sequence[int]]) -> bytes:
    """Pack {topic: header stamps in nanoseconds, in the order of their log times}."""
    buffer = io.BytesIO()
    names = {
        topic.replace("/", "|"): np.array(values, dtype=np.int64)
        for topic, values in stamps.items()
    }
    np.savez_compressed(buffer, **names)  # type: ignore[arg-type]
    return buffer.getvalue()


def unpack(data: bytes, most: int) -> dict[str, NDArray[np.int64]]:
    """Unpack {topic: header stamps (N,) in nanoseconds}; empty where the attachment is not ours.

    Args:
        data: of the attachment, which may hold anything.
        most: number of messages in the file; an index with more values is not read.
    """
    try:
        with zipfile.ZipFile(io.BytesIO(data)) as archive:
            members = archive.infolist()
            if sum(member.file_size for member in members) > 8 * most + _HEADER * len(members):
                return {}
            return {
                member.filename.removesuffix(".npy").replace("|", "/"): _values(
                    archive.read(member)
                )
                for member in members
            }
    except (OSError, ValueError, EOFError, KeyError, RuntimeError, zlib.error, zipfile.BadZipFile):
        return {}


def _values(content: bytes) -> NDArray[np.int64]:
    """Values of a NumPy file; ValueError unless it holds one row of integers and no more."""
    stream = io.BytesIO(content)
    if np.lib.format.read_magic(stream) != (1, 0):
        raise ValueError("another version")
    shape, _, kind = np.lib.format.read_array_header_1_0(stream)
    values = content[stream.tell() :]
    if len(shape) != 1 or kind != np.int64 or len(values) != 8 * shape[0]:
        raise ValueError("not a row of stamps")
    return np.frombuffer(values, dtype=np.int64)
