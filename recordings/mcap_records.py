"""Records of an MCAP file at their places, bounded before memory is taken for them."""

import struct
from pathlib import Path

from mcap.exceptions import McapError
from zstandard import ZstdError

from recordings.chunks import LARGEST_RECORD
from recordings.errors import RecordingError
from robot_assets.input_files import open_file

MAGIC = b"\x89MCAP0\r\n"
_OTHER_MAGIC = {
    b"#ROSBAG V2.0": "a ROS 1 bag",
    b"SQLite format 3\0": "an SQLite file, perhaps a ROS 2 bag in that format",
}
RECORD_HEAD = struct.Struct("<BQ")
"""Opcode, and length of the content."""
BROKEN = (
    McapError,
    OSError,
    ValueError,  # also a chunk whose CRC is wrong
    EOFError,
    struct.error,
    KeyError,
    UnicodeDecodeError,
    OverflowError,
    MemoryError,  # a length that is nonsense
    RuntimeError,  # lz4
    ZstdError,
)
"""What reading a broken record raises."""


class RecordFile:
    """File of records, opened for reading.

    Args:
        path: the file.

    Attributes:
        stream: the file; whoever reads from several threads takes turns.
        size: bytes of the file.

    Raises:
        RecordingError: the file does not exist or is not MCAP.
    """

    def __init__(self, path: Path) -> None:
        self.path = path
        if path.is_dir():
            raise RecordingError(f"{path} is a folder, and a recording is one .mcap file.")
        try:
            self.stream = open_file(path)
            head = self.stream.read(16)
        except OSError as error:
            raise RecordingError(f"{path} cannot be read: {error.strerror}.") from error
        if not head.startswith(MAGIC):
            self.stream.close()
            raise RecordingError(f"{path} is {_other(head)}.")
        self.size = self.stream.seek(0, 2)

    def check_open(self) -> None:
        """Raise RecordingError where the file was closed."""
        if self.stream.closed:
            raise RecordingError(f"{self.path} is closed.")

    def record(self, position: int, opcode: int) -> bytes:
        """Content of the record at a position; errors as in `place` and `content`."""
        return self.content(*self.place(position, opcode))

    def place(self, position: int, opcode: int) -> tuple[int, int]:
        """Offset and length of the content of the record at a position.

        Raises:
            ValueError: it is of another kind.
        """
        self.stream.seek(position)
        found, length = RECORD_HEAD.unpack(self.stream.read(RECORD_HEAD.size))
        if found != opcode:
            raise ValueError(f"a record has the opcode {found} instead of {opcode}")
        return position + RECORD_HEAD.size, length

    def content(self, start: int, length: int) -> bytes:
        """Bytes of the file.

        Raises:
            ValueError: it has not as many, or they are too many.
        """
        if start + length > self.size:
            raise ValueError("a record is longer than the file")
        if length > LARGEST_RECORD:
            raise ValueError(f"a record of {length} bytes is larger than {LARGEST_RECORD}")
        self.stream.seek(start)
        return self.stream.read(length)

    def close(self) -> None:
        """Close the file."""
        self.stream.close()


def broken_text(error: BaseException) -> str:
    """What is wrong with a record, without a full stop."""
    return str(error).strip().rstrip(".") or type(error).__name__


def _other(head: bytes) -> str:
    """What a file is that does not begin like MCAP."""
    found = next((kind for magic, kind in _OTHER_MAGIC.items() if head.startswith(magic)), None)
    if found is not None:
        return f"not an MCAP file but {found}"
    return "not an MCAP file" if head else "empty"
