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
    found = unpack(pack(stamps))
    assert {topic: values.tolist() for topic, values in found.items()} == stamps
    assert all(values.dtype == np.int64 for values in found.values())


@pytest.mark.parametrize("cut", [0, 1, 20, 100, -1])
def test_an_attachment_that_was_cut_is_no_index(cut: int):
    assert unpack(pack({"/a/image": list(range(1000))})[:cut]) == {}


@pytest.mark.parametrize("data", [b"", b"nonsense", b"PK\x03\x04" + bytes(40), b"\x93NUMPY"])
def test_an_attachment_of_others_is_no_index(data: bytes):
    assert unpack(data) == {}
