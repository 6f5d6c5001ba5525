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


def test_a_reading_again_within_half_a_period_is_a_duplicate_whatever_its_stamp():
    table = frame_table([stamps(0, 66, 66.00005, 80, 132), stamps(0, 66, 132)])
    assert table.stamps.tolist() == stamps(0, 66, 132).tolist()
    assert table.message.tolist() == [[0, 0], [3, 1], [4, 2]]
    assert table.duplicates == 2


def test_sensors_out_of_step_leave_frames_incomplete():
    together = frame_table([stamps(0, 66, 132), stamps(5, 71, 137)])
    apart = frame_table([stamps(0, 66, 132), stamps(40, 106, 172)])
    assert together.completeness == 1.0
    assert apart.completeness == 0.75


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
def test_frames_are_more_than_half_a_period_apart_and_hold_what_lies_within(
    sensors: list[list[int]],
):
    table = frame_table([np.array(s, dtype=np.int64) for s in sensors])
    assert (np.diff(table.stamps) > 0.5 * table.period).all()
    for n, sensor in enumerate(sensors):
        for frame, index in zip(table.stamps, table.message[:, n], strict=True):
            if index >= 0:
                assert 0 <= sensor[index] - frame <= 0.5 * table.period
