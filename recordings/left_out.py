"""Messages that are left out of a recording because they cannot be used."""

import re
import threading

_MOST_KINDS = 5
"""Reasons that are told apart in one topic."""


class LeftOut:
    """Messages that are left out, by topic and reason; thread-safe."""

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._told: dict[tuple[str, str], tuple[str, set[int]]] = {}
        self._chunks: set[int] = set()

    def add(self, topic: str, number: int, reason: str) -> None:
        """Note a message by its number in the file; the same one counts once.

        Reasons that differ in numbers alone are one, and the first is told.
        """
        key = (topic, re.sub(r"[0-9]+", "0", reason))
        with self._lock:
            if key not in self._told and self._count(topic) >= _MOST_KINDS:
                key, reason = (topic, ""), "there are further reasons"
            self._told.setdefault(key, (reason, set()))[1].add(number)

    def add_chunk(self, start: int) -> None:
        """Note a broken chunk of a long file by its offset; the same one counts once."""
        with self._lock:
            self._chunks.add(start)

    def sentences(self) -> list[str]:
        """A sentence for each topic and reason, with the number of messages."""
        with self._lock:
            told = [
                _sentence(topic, reason, numbers)
                for (topic, _), (reason, numbers) in self._told.items()
            ]
            return [broken_pieces(len(self._chunks)), *told] if self._chunks else told

    def _count(self, topic: str) -> int:
        return sum(of == topic for of, _ in self._told)


def broken_pieces(count: int) -> str:
    """Sentence about parts of a file that cannot be read."""
    return f"Broken pieces of the file, {count} of them, are left out."


def _sentence(topic: str, reason: str, numbers: set[int]) -> str:
    if len(numbers) == 1:
        return f"Message {min(numbers)} of {topic} is left out: {reason}."
    return f"{len(numbers)} messages of {topic} are left out, first {min(numbers)}: {reason}."
