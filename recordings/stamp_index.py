"""Attachment with the header stamps of all messages, so that opening a file reads no message."""

import io
import zipfile
import zlib
from collections.abc import Iterator, Mapping, Sequence
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

STAMP_INDEX = "header_stamps.npz"
MEDIA_TYPE = "application/x-npz"
_MANY = 50_000  # below it the attachment is as in older files
_TOPICS_APART = "\n"
_HEADER = 256
"""Bytes at most of the header of one array."""
_BROKEN = (
    OSError,
    ValueError,
    EOFError,
    KeyError,
    RuntimeError,
    zlib.error,
    zipfile.BadZipFile,
)


def pack(stamps: Mapping[str, Sequence[int]]) -> bytes:
    """Pack {topic: header stamps in nanoseconds, in the order of their log times}.

    Where there are many, topics with the same stamps, as all sensors of our files have, share one
    array.
    """
    many = sum(map(len, stamps.values())) >= _MANY
    sharing: dict[tuple[bytes, str], list[str]] = {}
    for topic, values in stamps.items():
        key = np.array(values, np.int64).tobytes(), "" if many else topic
        sharing.setdefault(key, []).append(topic)
    buffer = io.BytesIO()
    names = {
        _TOPICS_APART.join(topics).replace("/", "|"): np.frombuffer(values, np.int64)
        for (values, _), topics in sharing.items()
    }
    np.savez_compressed(buffer, **names)  # type: ignore[arg-type]
    return buffer.getvalue()


class StampIndex(Mapping[str, NDArray[np.int64]]):
    """Header stamps (N,) in nanoseconds by topics, unpacked where they are asked for.

    Args:
        archive: of the attachment.
        members: {topic: member of the archive}.
    """

    def __init__(self, archive: zipfile.ZipFile, members: dict[str, zipfile.ZipInfo]) -> None:
        self._archive, self._members = archive, members
        self._stamps = lru_cache(maxsize=1)(self._read)

    def __getitem__(self, topic: str) -> NDArray[np.int64]:
        """Stamps of a topic; KeyError where it has none, or they cannot be unpacked."""
        try:
            return self._stamps(self._members[topic].filename)
        except _BROKEN as error:
            raise KeyError(topic) from error

    def _read(self, member: str) -> NDArray[np.int64]:
        return _values(self._archive.read(member))

    def __iter__(self) -> Iterator[str]:
        return iter(self._members)

    def __len__(self) -> int:
        return len(self._members)


def unpack(data: bytes, most: int) -> Mapping[str, NDArray[np.int64]]:
    """Unpack {topic: header stamps (N,) in nanoseconds}; empty where the attachment is not ours.

    Args:
        data: of the attachment, which may hold anything.
        most: number of messages in the file; an index with more values is not read.
    """
    try:
        archive = zipfile.ZipFile(io.BytesIO(data))
        members = archive.infolist()
        if sum(member.file_size for member in members) > 8 * most + _HEADER * len(members):
            return {}
        for member in members:
            with archive.open(member) as stream:
                _check_header(io.BytesIO(stream.read(_HEADER)), member.file_size)
    except _BROKEN:
        return {}
    topics = {
        topic: member
        for member in members
        for topic in member.filename.removesuffix(".npy").replace("|", "/").split(_TOPICS_APART)
    }
    return StampIndex(archive, topics)


def _check_header(stream: io.BytesIO, size: int) -> None:
    """Raise ValueError unless a NumPy file of so many bytes holds one row of integers."""
    if np.lib.format.read_magic(stream) != (1, 0):
        raise ValueError("another version")
    shape, _, kind = np.lib.format.read_array_header_1_0(stream)
    if len(shape) != 1 or kind != np.int64 or size - stream.tell() != 8 * shape[0]:
        raise ValueError("not a row of stamps")


def _values(content: bytes) -> NDArray[np.int64]:
    """Values of a NumPy file; ValueError unless it holds one row of integers and no more."""
    stream = io.BytesIO(content)
    _check_header(stream, len(content))
    return np.frombuffer(content, np.int64, offset=stream.tell())
