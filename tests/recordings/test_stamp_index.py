import io
import zipfile

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from recordings.stamp_index import pack, unpack

NANOSECONDS = st.integers(-(2**63), 2**63 - 1)
TOPICS = st.lists(st.from_regex(r"\A(/[a-z_]{1,5}[0-9]?){1,3}\Z"), unique=True, max_size=3)


@given(st.data(), TOPICS)
def test_what_is_packed_comes_back_to_the_nanosecond(data: st.DataObject, topics: list[str]):
    stamps = {topic: data.draw(st.lists(NANOSECONDS, max_size=5)) for topic in topics}
    found = unpack(pack(stamps), sum(map(len, stamps.values())))
    assert {topic: values.tolist() for topic, values in found.items()} == stamps
    assert all(values.dtype == np.int64 for values in found.values())


@pytest.mark.parametrize("cut", [0, 1, 20, 100, -1])
def test_an_attachment_that_was_cut_is_no_index(cut: int):
    assert unpack(pack({"/a/image": list(range(1000))})[:cut], 1000) == {}


@pytest.mark.parametrize("data", [b"", b"nonsense", b"PK\x03\x04" + bytes(40), b"\x93NUMPY"])
def test_an_attachment_of_others_is_no_index(data: bytes):
    assert unpack(data, 1000) == {}


def archive(**arrays: np.ndarray) -> bytes:
    buffer = io.BytesIO()
    np.savez_compressed(buffer, **arrays)  # type: ignore[arg-type]
    return buffer.getvalue()


@pytest.mark.parametrize(
    "array",
    [np.zeros((2, 3), np.int64), np.int64(5), np.full(4, np.nan), np.zeros(4, np.int32)],
)
def test_anything_but_rows_of_integers_is_no_index(array: np.ndarray):
    assert unpack(archive(a=array), 1000) == {}


def test_no_memory_is_taken_for_more_stamps_than_there_are_messages():
    assert unpack(archive(a=np.zeros(5_000_000, np.int64)), 100) == {}
    header = io.BytesIO()
    declared = {"descr": "<i8", "fortran_order": False, "shape": (2**40,)}
    np.lib.format.write_array_header_1_0(header, declared)
    buffer = io.BytesIO()
    with zipfile.ZipFile(buffer, "w") as claimed:
        claimed.writestr("a.npy", header.getvalue())
    assert unpack(buffer.getvalue(), 100) == {}
