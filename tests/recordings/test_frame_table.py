import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from recordings.frame_table import frame_table

MS = 1_000_000


def stamps(*milliseconds: float) -> np.ndarray:
    return np.array([round(m * MS) for m in milliseconds], dtype=np.int64)


def test_messages_within_half_a_period_are_one_frame_with_the_earliest_stamp():
    table = frame_table([stamps(0, 66, 132), stamps(3, 60, 140)])
    assert table.stamps.tolist() == stamps(0, 60, 132).tolist()
    assert table.message.tolist() == [[0, 0], [1, 1], [2, 2]]


def test_a_sensor_that_missed_a_frame_has_no_message_there():
    table = frame_table([stamps(0, 66, 132, 198), stamps(0, 198)])
    assert table.message.tolist() == [[0, 0], [1, -1], [2, -1], [3, 1]]


def test_of_equal_stamps_the_last_is_kept_and_the_rest_counted():
    table = frame_table([stamps(0, 66, 66, 66, 132), stamps(0, 66, 66, 132, 198)])
    assert table.stamps.tolist() == stamps(0, 66, 132, 198).tolist()
    assert table.message.tolist() == [[0, 0], [3, 2], [4, 3], [-1, 4]]
    assert table.duplicates == 2


def test_a_sensor_alone_gives_a_frame_for_every_stamp_whatever_the_jitter():
    table = frame_table([stamps(0, 66, 80, 132, 400)])
    assert len(table.stamps) == 5


def test_stamps_out_of_order_are_put_in_order():
    table = frame_table([stamps(132, 0, 66)])
    assert table.message[:, 0].tolist() == [1, 2, 0]


def test_no_messages_give_no_frames():
    table = frame_table([stamps(), stamps()])
    assert len(table.stamps) == 0
    assert table.message.shape == (0, 2)


@given(
    st.lists(
        st.lists(st.integers(0, 2000).map(lambda m: m * MS), max_size=30), min_size=1, max_size=4
    )
)
def test_stamps_increase_and_every_distinct_reading_is_in_one_frame(sensors: list[list[int]]):
    table = frame_table([np.array(s, dtype=np.int64) for s in sensors])
    assert (np.diff(table.stamps) > 0).all()
    for n, sensor in enumerate(sensors):
        used = table.message[:, n]
        used = used[used >= 0]
        assert sorted(sensor[i] for i in used) == sorted(set(sensor))
        assert all(i == len(sensor) - 1 - sensor[::-1].index(sensor[i]) for i in used)
