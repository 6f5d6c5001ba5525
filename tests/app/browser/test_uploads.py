import pytest
from hypothesis import given
from hypothesis import strategies as st

from app.browser.uploads import LARGEST_UPLOAD, Part, Uploads


def test_a_file_that_fits_is_taken_to_its_last_byte():
    uploads = Uploads()
    assert uploads.begin("a", 2, 600_000)
    assert uploads.take("a", 0, 524_288) is Part.TAKEN
    assert uploads.take("a", 1, 75_712) is Part.TAKEN
    assert uploads.take("a", 1, 1) is Part.UNEXPECTED  # it is complete
    assert uploads.begin("b", 2, LARGEST_UPLOAD)
    assert uploads.begin("empty", 0, 0)


def test_what_is_too_large_is_refused_and_its_parts_are_left_out():
    uploads = Uploads()
    assert not uploads.begin("a", 1000, 500_000_000)
    assert {uploads.take("a", k, 524_288) for k in range(1000)} == {Part.LEFT_OUT}
    assert uploads.begin("b", 1, LARGEST_UPLOAD)


def test_all_incomplete_files_count_together_also_what_has_come_of_them():
    uploads = Uploads()
    assert uploads.begin("a", 2, 700_000)
    assert uploads.take("a", 0, 600_000) is Part.TAKEN
    assert not uploads.begin("b", 1, 400_000)
    assert uploads.take("a", 1, 100_000) is Part.TAKEN
    assert uploads.begin("c", 1, 400_000)


def test_more_than_was_announced_is_not_taken():
    uploads = Uploads()
    assert uploads.take("never", 0, 1) is Part.UNEXPECTED
    uploads.begin("a", 2, 5000)
    assert uploads.take("a", 0, 4000) is Part.TAKEN
    assert uploads.take("a", 0, 10) is Part.UNEXPECTED
    assert uploads.take("a", 2, 10) is Part.UNEXPECTED
    assert uploads.take("a", -1, 10) is Part.UNEXPECTED
    assert uploads.take("a", 1, 1001) is Part.UNEXPECTED
    assert uploads.take("a", 1, 1000) is Part.TAKEN


@pytest.mark.parametrize(("parts", "size"), [(-1, 5), (1, -5), (0, 5), (1, 0), (10**9, 10**6)])
def test_no_page_announces_such_files(parts, size):
    with pytest.raises(ValueError, match="bytes in"):
        Uploads().begin("a", parts, size)


@given(st.lists(st.tuples(*[st.integers(0, 4)] * 3, st.integers(0, 600_000))))
def test_what_viser_keeps_is_bounded_whatever_is_sent(steps):
    uploads, kept = Uploads(), {}
    for upload, parts, index, size in steps:
        name = str(upload)
        if index == 4:
            try:
                if uploads.begin(name, parts, size) and parts:
                    kept[name] = (parts, {})
            except ValueError:
                pass
        elif uploads.take(name, index, size) is Part.TAKEN:
            count, seen = kept[name]
            assert index not in seen
            seen[index] = size
            if len(seen) == count:
                del kept[name]
        assert sum(sum(seen.values()) for _, seen in kept.values()) <= LARGEST_UPLOAD
