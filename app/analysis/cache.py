"""Bounded, thread-safe cache of values that are expensive to compute."""

import threading
from collections import OrderedDict
from collections.abc import Callable, Hashable
from typing import Generic, TypeVar

K = TypeVar("K", bound=Hashable)
V = TypeVar("V")


class _Slot(Generic[V]):
    def __init__(self) -> None:
        self.lock = threading.Lock()
        self.value: V | None = None
        self.weight = 0


class Cache(Generic[K, V]):
    """Cache of the `size` values used last; each is computed once, by one thread.

    Args:
        size: values at most.
        weigh: a measure of a value's memory.
        heaviest: of all values together; a value alone may weigh more.
    """

    def __init__(
        self, size: int, weigh: Callable[[V], int] = lambda _: 0, heaviest: int = 0
    ) -> None:
        self._size = size
        self._weigh, self._heaviest = weigh, heaviest
        self._weight = 0
        self._lock = threading.Lock()
        self._slots: OrderedDict[K, _Slot[V]] = OrderedDict()

    def __len__(self) -> int:
        return len(self._slots)

    def known(self, key: K) -> V | None:
        """The cached value of `key`, or None; never computes or waits."""
        with self._lock:
            slot = self._slots.get(key)
        return slot.value if slot else None

    def items(self) -> list[tuple[K, V]]:
        """All cached keys and values."""
        with self._lock:
            slots = list(self._slots.items())
        return [(key, slot.value) for key, slot in slots if slot.value is not None]

    def get(self, key: K, make: Callable[[], V]) -> V:
        """The value of `key`, computed by `make` unless cached; raises what `make` raises."""
        with self._lock:
            slot = self._slots.setdefault(key, _Slot())
            self._slots.move_to_end(key)
            while len(self._slots) > self._size:
                self._forget_oldest()
        # A lock per key: a value being computed delays only the threads that need it.
        with slot.lock:
            if slot.value is None:
                slot.value = make()
                self._weigh_in(key, slot, self._weigh(slot.value))
            return slot.value

    def _weigh_in(self, key: K, slot: _Slot[V], weight: int) -> None:
        with self._lock:
            if self._slots.get(key) is not slot:
                return  # forgotten while it was made
            slot.weight = weight
            self._weight += weight
            while self._weight > self._heaviest and len(self._slots) > 1:
                self._forget_oldest()

    def _forget_oldest(self) -> None:
        _, slot = self._slots.popitem(last=False)
        self._weight -= slot.weight
