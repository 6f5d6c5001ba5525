from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from recordings import Recording, open_recording
from recordings.mcap_file import McapFile
from tests.recordings.long_recording import (
    RATE,
    SECONDS,
    Message,
    rewritten,
    without_index,
    write_long,
)

FRAMES = SECONDS * RATE
ORDERS = st.lists(st.integers(0, FRAMES - 1), min_size=1, max_size=6)
FEW = settings(
    max_examples=25, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture]
)


@pytest.fixture(scope="module")
def path(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return write_long(tmp_path_factory.mktemp("long") / "long.mcap")


@pytest.fixture(scope="module")
def whole(path: Path) -> Iterator[Recording]:
    """The recording with all poses decoded at opening."""
    with opened_whole(path) as recording:
        yield recording


@pytest.fixture(scope="module")
def nearby(path: Path) -> Iterator[Recording]:
    with open_recording(path) as recording:
        yield recording


def opened_whole(path: Path) -> Recording:
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("recordings.mcap_index.LONG", 10**9)
        return open_recording(path)


def assert_same(found: Recording, expected: Recording, k: int) -> None:
    cloud, other = found.cloud(k), expected.cloud(k)
    assert len(cloud.points) > 500
    np.testing.assert_allclose(cloud.points, other.points, atol=1e-9)
    np.testing.assert_allclose(cloud.T_fixed_sensor, other.T_fixed_sensor, atol=1e-9)
    assert found.joint_positions(k) == pytest.approx(expected.joint_positions(k), abs=1e-9)
    links = expected.link_poses(k)
    assert len(links) == len(found.link_poses(k)) > 5
    for link, pose in found.link_poses(k).items():
        np.testing.assert_allclose(pose, links[link], atol=1e-9)
    truth, other_truth = found.truth(k), expected.truth(k)
    assert truth is not None
    assert other_truth is not None
    np.testing.assert_allclose(truth, other_truth, atol=1e-9)


def test_a_long_recording_is_read_around_its_frames_and_a_short_one_as_a_whole(path: Path):
    file = McapFile(path)
    assert file.long
    assert file.message_count > 2 * SECONDS * 1000
    file.close()


@FEW
@given(ORDERS)
def test_frames_are_the_same_as_if_all_poses_were_decoded_in_any_order(
    whole: Recording, nearby: Recording, order: list[int]
):
    for k in order:
        assert_same(nearby, whole, k)


@FEW
@given(st.integers(0, FRAMES - 9))
def test_so_is_the_truth_over_pairs(whole: Recording, nearby: Recording, k: int):
    found, expected = nearby.pair_truth(k, k + 8), whole.pair_truth(k, k + 8)
    assert found is not None
    assert expected is not None
    assert found.points is not None
    assert expected.points is not None
    np.testing.assert_allclose(found.velocity, expected.velocity, atol=1e-9)
    np.testing.assert_allclose(found.points, expected.points, atol=1e-6)


def test_what_is_known_at_opening_is_the_same(whole: Recording, nearby: Recording):
    assert nearby.stamps.tolist() == whole.stamps.tolist()
    assert nearby.unplaced.tolist() == whole.unplaced.tolist()
    assert nearby.warnings == whole.warnings == ()
    assert nearby.fixed_frame == whole.fixed_frame


def test_opening_reads_the_first_and_the_last_chunks_alone(
    path: Path, monkeypatch: pytest.MonkeyPatch
):
    read: set[int] = set()
    chunk = McapFile._chunk

    def noted(self: McapFile, start: int) -> bytes:
        read.add(start)
        return chunk(self, start)

    monkeypatch.setattr(McapFile, "_chunk", noted)
    with open_recording(path) as recording:
        file = McapFile(path)
        starts = sorted({int(s) for c in file.channels for s in file.table(c).chunk.tolist()})
        file.close()
        assert read <= {*starts[:4], *starts[-4:]}
        before = len(read)
        recording.cloud(FRAMES // 2)
        assert len(read) - before <= 6
    assert len(starts) > 40


def test_without_an_index_stamps_are_those_of_arrival(path: Path, whole: Recording, tmp_path: Path):
    with open_recording(without_index(path, tmp_path / "bare.mcap")) as bare:
        assert bare.stamps.tolist() == whole.stamps.tolist()
        assert bare.warnings == ()
        for k in (0, 333, FRAMES - 1):
            assert_same(bare, whole, k)


def later(messages: list[Message], by: np.ndarray) -> list[Message]:
    """Messages that arrive later than their stamps, by nanoseconds, in the order of arrival."""
    moved = [(*m[:4], m[4] + int(d)) for m, d in zip(messages, by, strict=True)]
    return sorted(moved, key=lambda message: message[4])


@pytest.mark.parametrize("jitter", [0, 10_000_000])
def test_messages_that_arrive_late_keep_their_stamps(
    path: Path, whole: Recording, tmp_path: Path, jitter: int
):
    rng = np.random.default_rng(0)

    def late(messages: list[Message]) -> list[Message]:
        return later(messages, 5_000_000 + rng.integers(0, jitter + 1, len(messages)))

    copy = rewritten(path, tmp_path / "late.mcap", late)
    with open_recording(copy) as found:
        np.testing.assert_allclose(found.stamps, whole.stamps, atol=1e-9)
        for k in (0, 401, FRAMES - 1):
            assert_same(found, whole, k)


def test_poses_that_are_out_of_order_across_chunks_are_found(
    path: Path, whole: Recording, tmp_path: Path
):
    def swapped(messages: list[Message]) -> list[Message]:
        late = [m[0] in ("/tf", "/joint_states") and n % 7 < 2 for n, m in enumerate(messages)]
        return later(messages, 50_000_000 * np.array(late))

    copy = rewritten(path, tmp_path / "swapped.mcap", swapped)
    with open_recording(copy) as found:
        for k in (3, 87, 450, 888):
            assert_same(found, whole, k)


def test_a_damaged_chunk_costs_the_frames_in_it_and_one_sentence(
    path: Path, whole: Recording, tmp_path: Path
):
    file = McapFile(path)
    depth = next(c for c in file.channels if c.topic.endswith("image"))
    table = file.table(depth)
    start = int(table.chunk[FRAMES // 2])
    lost = np.flatnonzero(table.chunk == start)
    file.close()
    content = bytearray(path.read_bytes())
    content[start + 1000 : start + 1100] = bytes(100)
    copy = tmp_path / "damaged.mcap"
    copy.write_bytes(bytes(content))
    with open_recording(copy) as found:
        assert found.warnings == ()
        assert len(found) == FRAMES
        for k in (5, int(lost[0]) - 20, int(lost[-1]) + 20):
            assert_same(found, whole, k)
        assert found.warnings == () or len(found.warnings) == 1
        assert len(found.cloud(int(lost[1])).points) == 0
        assert found.warnings == ("Broken pieces of the file, 1 of them, are left out.",)
