"""Cache of intermediate results, shared between estimates of the same pair."""

import threading
from collections import OrderedDict
from collections.abc import Callable, Hashable
from typing import Any, TypeVar

T = TypeVar("T")

_CACHED = 512  # a few of the largest estimates, with twenty rounds of every cluster


class Stages:
    """Thread-safe LRU cache of one pair's intermediate results.

    A result is a pure function of the pair's clouds and the key, so that an estimate is the same
    with or without the cache.
    """

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._results: OrderedDict[Hashable, Any] = OrderedDict()
        self.reused = 0
        """Number of results that were asked for again."""

    def __len__(self) -> int:
        return len(self._results)

    def get(self, key: Hashable, make: Callable[[], T]) -> T:
        """Cached result of a stage, computed where it is missing.

        Args:
            key: the stage's name, and everything but the clouds that its result depends on.
            make: computes the result, which must not be modified; two threads may both call it.
        """
        with self._lock:
            if key in self._results:
                self._results.move_to_end(key)
                self.reused += 1
                return self._results[key]
        result = make()
        with self._lock:
            self._results[key] = result
            while len(self._results) > _CACHED:
                self._results.popitem(last=False)
        return result
