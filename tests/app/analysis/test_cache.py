import threading
import time

import pytest

from app.analysis.cache import Cache


def test_a_value_is_made_once():
    made = []
    cache = Cache(3)
    for _ in range(3):
        assert cache.get("a", lambda: made.append(1) or "value") == "value"
    assert made == [1]


def test_the_one_asked_for_longest_ago_is_forgotten():
    made = []
    cache = Cache(2)
    for key in ("a", "b", "a", "c", "a", "b"):
        cache.get(key, lambda key=key: made.append(key) or key)
    assert made == ["a", "b", "c", "b"]
    assert len(cache) == 2


def test_two_threads_wait_for_one_value():
    made = []

    def make():
        time.sleep(0.1)
        made.append(1)
        return object()

    cache, got = Cache(3), []
    threads = [threading.Thread(target=lambda: got.append(cache.get("a", make))) for _ in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert made == [1]
    assert len(set(got)) == 1


def test_what_fails_is_tried_again():
    cache = Cache(3)

    def fail():
        raise ValueError("not now")

    with pytest.raises(ValueError, match="not now"):
        cache.get("a", fail)
    assert cache.get("a", lambda: 7) == 7
