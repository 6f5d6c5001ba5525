"""Messages that are left out of a recording because they cannot be used."""

import threading


class LeftOut:
    """Messages that are left out, by topic and reason; thread-safe."""

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._messages: dict[tuple[str, str], set[int]] = {}

    def add(self, topic: str, number: int, reason: str) -> None:
        """Note a message by its number in the file; the same one counts once."""
        with self._lock:
            self._messages.setdefault((topic, reason), set()).add(number)

    def sentences(self) -> list[str]:
        """A sentence for each topic and reason, with the number of messages."""
        with self._lock:
            return [
                _sentence(topic, reason, numbers)
                for (topic, reason), numbers in self._messages.items()
            ]


def _sentence(topic: str, reason: str, numbers: set[int]) -> str:
    if len(numbers) == 1:
        return f"Message {min(numbers)} of {topic} is left out: {reason}."
    return f"{len(numbers)} messages of {topic} are left out, first {min(numbers)}: {reason}."
