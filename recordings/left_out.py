"""Messages that are left out of a recording because they cannot be used."""

import threading


class LeftOut:
    """Messages that are left out, by topic and reason; thread-safe."""

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._messages: dict[tuple[str, str], set[int]] = {}

    def add(self, topic: str, index: int, reason: str) -> None:
        """Note a message by its index; the same one counts once."""
        with self._lock:
            self._messages.setdefault((topic, reason), set()).add(index)

    def sentences(self) -> list[str]:
        """A sentence for each topic and reason, with the number of messages."""
        with self._lock:
            return [
                _sentence(topic, reason, indices)
                for (topic, reason), indices in self._messages.items()
            ]


def _sentence(topic: str, reason: str, indices: set[int]) -> str:
    if len(indices) == 1:
        return f"Message {min(indices)} of {topic} is left out: {reason}."
    return f"{len(indices)} messages of {topic} are left out, first {min(indices)}: {reason}."
