import pytest

from app.browser.pace import Pace


def spent(seconds: float, sizes: list[int], pause: float = 0.0) -> int:
    """Messages that are read in this time, from a client that always has another one."""
    pace, now, count = Pace(0.0), 0.0, 0
    while now < seconds:
        now += pause + pace.wait(sizes[count % len(sizes)], now)
        count += 1
    return count


def test_who_sends_as_a_page_does_never_waits():
    pace = Pace(0.0)
    assert not any(pace.wait(200, k / 240) for k in range(240 * 60))  # a slider, every 4 ms
    pace = Pace(0.0)
    assert not any(pace.wait(0, 0.0) for _ in range(290))  # all at once


def test_a_flood_is_read_at_three_hundred_messages_a_second():
    assert spent(10.0, [50]) == pytest.approx(300 + 300 * 10, rel=0.01)


def test_those_who_flood_share_what_one_may_send():
    paces, now = [Pace(0.0) for _ in range(20)], 0.0
    due, counts = [0.0] * 20, [0] * 20
    for _ in range(60_000):
        k = min(range(20), key=due.__getitem__)
        now = due[k]
        waiting = sum(time > now for time in due)
        due[k] = now + paces[k].wait(50, now, waiting)
        counts[k] += 1
        if now > 30.0:
            break
    assert sum(counts) == pytest.approx(20 * 300 + 300 * 30, rel=0.15)
    assert min(counts) > 300
    # One who keeps within the budget is read as ever.
    pace = Pace(0.0)
    assert not any(pace.wait(200, k / 240, 19) for k in range(240 * 60))


def test_large_messages_cost_by_their_size():
    megabytes = spent(10.0, [50_000_000]) * 50
    assert 500 <= megabytes <= 1000
