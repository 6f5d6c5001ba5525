"""A bounded memory of things that are expensive to make, shared between sessions."""

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


class Cache(Generic[K, V]):
    """The `size` values that were asked for last; each is made once, also under many threads."""

    def __init__(self, size: int) -> None:
        self._size = size
        self._lock = threading.Lock()
        self._slots: OrderedDict[K, _Slot[V]] = OrderedDict()

    def __len__(self) -> int:
        return len(self._slots)

    def known(self, key: K) -> V | None:
        """The value of `key` where it is remembered; nothing is made, and nobody is waited for."""
        with self._lock:
            slot = self._slots.get(key)
        return slot.value if slot else None

    def items(self) -> list[tuple[K, V]]:
        """All keys and values that are remembered now."""
        with self._lock:
            slots = list(self._slots.items())
        return [(key, slot.value) for key, slot in slots if slot.value is not None]

    def get(self, key: K, make: Callable[[], V]) -> V:
        """The value of `key`; `make` makes it where it is not remembered, and may raise."""
        with self._lock:
            slot = self._slots.setdefault(key, _Slot())
            self._slots.move_to_end(key)
            while len(self._slots) > self._size:
                self._slots.popitem(last=False)
        # Whoever asks for a value that is being made waits for it; nobody else does.
        with slot.lock:
            if slot.value is None:
                slot.value = make()
            return slot.value
