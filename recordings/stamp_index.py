"""Attachment with the header stamps of all messages, so that opening a file reads no message."""

import io
import zipfile
import zlib
from collections.abc import Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

STAMP_INDEX = "header_stamps.npz"
MEDIA_TYPE = "application/x-npz"


def pack(stamps: Mapping[str, Sequence[int]]) -> bytes:
    """Pack {topic: header stamps in nanoseconds, in the order of their log times}."""
    buffer = io.BytesIO()
    names = {topic.replace("/", "|"): np.array(values) for topic, values in stamps.items()}
    np.savez_compressed(buffer, **names)  # type: ignore[arg-type]
    return buffer.getvalue()


def unpack(data: bytes) -> dict[str, NDArray[np.int64]]:
    """{topic: header stamps (N,) in nanoseconds}; empty where the attachment is not ours."""
    try:
        with np.load(io.BytesIO(data), allow_pickle=False) as content:
            return {name.replace("|", "/"): content[name].astype(np.int64) for name in content}
    except (OSError, ValueError, EOFError, KeyError, zlib.error, zipfile.BadZipFile):
        return {}
