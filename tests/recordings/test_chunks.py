"""Chunks are decompressed within bounds."""

import struct
import zlib

import lz4.frame
import pytest
import zstandard

from recordings import chunks
from recordings.chunks import Budget, chunk_data

_COMPRESS = {"": bytes, "zstd": zstandard.compress, "lz4": lz4.frame.compress}
_KINDS = pytest.mark.parametrize("compression", _COMPRESS)


def record(data: bytes, compression: str, size: int | None = None, crc: int | None = None) -> bytes:
    packed = _COMPRESS[compression](data)
    head = struct.pack("<QQ", 0, 0)
    head += struct.pack("<Q", len(data) if size is None else size)
    head += struct.pack("<I", zlib.crc32(data) if crc is None else crc)
    head += struct.pack("<I", len(compression)) + compression.encode()
    return head + struct.pack("<Q", len(packed)) + packed


@_KINDS
def test_what_was_packed_comes_back(compression: str):
    data = bytes(range(256)) * 1000
    assert chunk_data(record(data, compression)) == data
    assert chunk_data(record(data, compression, crc=0)) == data  # 0: there is none


@_KINDS
def test_one_that_is_too_large_is_not_read(compression: str, monkeypatch: pytest.MonkeyPatch):
    monkeypatch.setattr(chunks, "LARGEST_RECORD", 1000)
    with pytest.raises(ValueError, match="a chunk of 1001 bytes is larger than 1000"):
        chunk_data(record(bytes(1001), compression))


@pytest.mark.parametrize("compression", ["zstd", "lz4"])
@pytest.mark.parametrize("claimed", [0, 999, 1001])
def test_one_of_another_size_than_it_says_is_refused(compression: str, claimed: int):
    with pytest.raises(ValueError, match="does not have the size that it says"):
        chunk_data(record(bytes(1000), compression, size=claimed))


@_KINDS
def test_a_wrong_check_sum_is_refused(compression: str):
    with pytest.raises(ValueError, match="CRC"):
        chunk_data(record(bytes(1000), compression, crc=5))


def test_another_compression_is_named(monkeypatch: pytest.MonkeyPatch):
    monkeypatch.setitem(_COMPRESS, "brotli", bytes)
    with pytest.raises(ValueError, match="the compression 'brotli' is not known"):
        chunk_data(record(b"", "brotli"))


def test_chunks_that_become_too_many_times_the_file_are_left_out(monkeypatch: pytest.MonkeyPatch):
    monkeypatch.setattr(chunks, "_MOST_ANYWAY", 1000)
    budget = Budget(30)  # whose chunks may have 3000 bytes
    for _ in range(2):
        chunk_data(record(bytes(1400), "zstd"), budget)
    with pytest.raises(ValueError, match="too many times its size"):
        budget.take(300)
    budget.take(200)
    with pytest.raises(ValueError, match="larger than"):
        chunk_data(record(b"", "", size=2**60), budget)
