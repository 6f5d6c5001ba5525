"""What the stages of an estimate found out about a pair, for the next estimate of the same pair."""

import threading
from collections import OrderedDict
from collections.abc import Callable, Hashable
from typing import Any, TypeVar

T = TypeVar("T")

_REMEMBERED = 512  # a few of the largest estimates, with twenty rounds of every cluster


class Stages:
    """A bounded memory of one pair, safe under many threads; what was asked for last is kept.

    A stage is a pure function of the pair's clouds and of its key, so that an estimate is the
    same whether something was remembered or not.
    """

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._results: OrderedDict[Hashable, Any] = OrderedDict()

    def __len__(self) -> int:
        return len(self._results)

    def get(self, key: Hashable, make: Callable[[], T]) -> T:
        """The result of a stage, from memory or else made.

        Args:
            key: the stage's name, and everything but the clouds that its result depends on.
            make: makes what nobody may change afterwards; two threads may both make it.
        """
        with self._lock:
            if key in self._results:
                self._results.move_to_end(key)
                return self._results[key]
        result = make()
        with self._lock:
            self._results[key] = result
            while len(self._results) > _REMEMBERED:
                self._results.popitem(last=False)
        return result
