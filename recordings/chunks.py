"""Chunks of an MCAP file: decompression, bounded before memory is taken for it."""

import zlib
from collections.abc import Callable
from io import BytesIO

import lz4.frame
import zstandard
from mcap.data_stream import ReadDataStream
from mcap.records import Chunk

LARGEST_RECORD = 256 * 2**20
"""Bytes of a chunk, compressed or not, and of any other record that is read as a whole.

Writers make chunks of one to some ten MB; a larger record is left out like a broken one.
"""

_BOMB, _RATIO = 2**22, 1000
"""Bytes above which a chunk may not be so many times as large as its compressed form."""

_MOST_ANYWAY, _MOST_TIMES = 2**28, 100
"""Bytes that a file's chunks may have in all, or else so many times the file's size."""


class Budget:
    """Bytes that the chunks of a file may become; those beyond are left out.

    Args:
        size: bytes of the file.
    """

    def __init__(self, size: int) -> None:
        self._left = max(_MOST_ANYWAY, _MOST_TIMES * size)

    def take(self, size: int) -> None:
        """Take the bytes of a chunk.

        Raises:
            ValueError: there are not as many left.
        """
        if size > self._left:
            raise ValueError("the file's chunks become too many times its size")
        self._left -= size


def chunk_data(record: bytes, budget: Budget | None = None) -> bytes:
    """Decompress a chunk record; its size and its CRC are checked.

    Args:
        record: its content.
        budget: of the file, from which its size is taken; None where that was done before.

    Raises:
        ValueError: it is too large, or its records are not what its head says.
    """
    chunk = Chunk.read(ReadDataStream(BytesIO(record)))
    size = chunk.uncompressed_size
    if size > LARGEST_RECORD:
        raise ValueError(f"a chunk of {size} bytes is larger than {LARGEST_RECORD}")
    if size > _BOMB and size > _RATIO * len(chunk.data):
        raise ValueError(f"a chunk of {len(chunk.data)} bytes becomes one of {size}")
    if budget is not None:
        budget.take(size)
    if chunk.compression == "":
        data = chunk.data
    elif chunk.compression in _DECOMPRESS:
        data = _DECOMPRESS[chunk.compression](chunk.data, size + 1)
        if len(data) != size:
            raise ValueError("a chunk does not have the size that it says")
    else:
        raise ValueError(f"the compression {chunk.compression!r} is not known")
    if chunk.uncompressed_crc and zlib.crc32(data) != chunk.uncompressed_crc:
        raise ValueError("the check sum (CRC) of a chunk is wrong")
    return data


def _unzstd(data: bytes, most: int) -> bytes:
    # A reader, since decompress() believes the size in the frame and takes memory for it.
    with zstandard.ZstdDecompressor().stream_reader(data) as reader:
        return reader.read(most)


def _unlz4(data: bytes, most: int) -> bytes:
    return lz4.frame.LZ4FrameDecompressor().decompress(data, max_length=most)


_DECOMPRESS: dict[str, Callable[[bytes, int], bytes]] = {"zstd": _unzstd, "lz4": _unlz4}
"""{compression: function that gives so many bytes at most}."""
