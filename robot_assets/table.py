"""Reading a TOML table key by key, with one sentence for whatever is wrong."""

from typing import Any

import numpy as np
from numpy.typing import NDArray

_LARGEST = 1e6


class TableError(Exception):
    """A key is missing, unknown, or holds a wrong value; the sentence names it."""


class Table:
    """A TOML table that remembers which of its keys were read.

    Args:
        content: the table as tomllib gives it.
        path: where it stands in the file, for the sentences.
    """

    def __init__(self, content: dict[str, Any], path: str = "") -> None:
        self._content = content
        self._path = path
        self._read: set[str] = set()

    def text(self, key: str, otherwise: str | None = None) -> str:
        """A string that is not empty; `otherwise` where the key is not there."""
        if otherwise is not None and key not in self._content:
            self._read.add(key)
            return otherwise
        value = self._get(key)
        if not isinstance(value, str) or not value:
            raise self._wrong(key, "a text", value)
        return value

    def choice(self, key: str, choices: tuple[str, ...]) -> str:
        """One of a few strings."""
        value = self._get(key)
        if value not in choices:
            raise self._wrong(key, " or ".join(f'"{c}"' for c in choices), value)
        return str(value)

    def boolean(self, key: str) -> bool:
        """True or false."""
        value = self._get(key)
        if not isinstance(value, bool):
            raise self._wrong(key, "true or false", value)
        return value

    def integer(self, key: str, low: int, high: int) -> int:
        """A whole number within bounds."""
        value = self._get(key)
        if isinstance(value, bool) or not isinstance(value, int) or not low <= value <= high:
            raise self._wrong(key, f"a whole number from {low} to {high}", value)
        return value

    def number(self, key: str, low: float, high: float) -> float:
        """A number within bounds."""
        value = self._get(key)
        if not _is_number(value) or not low <= value <= high:
            raise self._wrong(key, f"a number from {low:g} to {high:g}", value)
        return float(value)

    def number_or_two(self, key: str, low: float, high: float) -> tuple[float, float | None]:
        """A number within bounds, or two of them; the second is None where there is one."""
        value = self._get(key)
        several = value if isinstance(value, list) else [value]
        inside = all(_is_number(one) and low <= one <= high for one in several)
        if len(several) not in (1, 2) or not inside:
            raise self._wrong(key, f"a number from {low:g} to {high:g}, or two of them", value)
        return float(several[0]), float(several[1]) if len(several) == 2 else None

    def vector(self, key: str, nonzero: bool = False) -> NDArray[np.float64]:
        """Three numbers, as (3,)."""
        value = self._get(key)
        if not isinstance(value, list) or len(value) != 3 or not all(map(_is_number, value)):
            raise self._wrong(key, "three numbers", value)
        vector = np.array(value, dtype=np.float64)
        if nonzero and np.linalg.norm(vector) < 1e-9:
            raise self._wrong(key, "a direction, not zero", value)
        return vector

    def direction_across(self, key: str, axis: NDArray[np.float64]) -> NDArray[np.float64]:
        """Three numbers, made a unit vector at a right angle to the unit vector `axis`."""
        vector = self.vector(key, nonzero=True)
        across = vector - (vector @ axis) * axis
        if np.linalg.norm(across) < 1e-6 * np.linalg.norm(vector):
            raise self._wrong(
                key, f"a direction that is not along {axis.tolist()}", vector.tolist()
            )
        return across / np.linalg.norm(across)

    def table(self, key: str) -> "Table":
        """A table inside this one."""
        value = self._get(key)
        if not isinstance(value, dict):
            raise self._wrong(key, "a table", value)
        return Table(value, self._name(key))

    def tables(self, key: str) -> list["Table"]:
        """The tables of an array of tables, none where the key is not there."""
        self._read.add(key)
        value = self._content.get(key, [])
        if not isinstance(value, list) or not all(isinstance(item, dict) for item in value):
            raise self._wrong(key, "tables, each headed [[" + key + "]]", value)
        return [Table(item, f"{self._name(key)}[{i}]") for i, item in enumerate(value)]

    def finish(self) -> None:
        """Raise TableError where the table has keys that nobody read."""
        if unknown := sorted(set(self._content) - self._read):
            known = ", ".join(sorted(self._read))
            raise TableError(f"{self._name(unknown[0])} is not a known key; known are {known}.")

    def _get(self, key: str) -> Any:  # noqa: ANN401 (whatever TOML holds)
        self._read.add(key)
        if key not in self._content:
            raise TableError(f"{self._name(key)} is missing.")
        return self._content[key]

    def _name(self, key: str) -> str:
        return f"{self._path}.{key}" if self._path else key

    def _wrong(self, key: str, expected: str, value: object) -> TableError:
        return TableError(f"{self._name(key)} must be {expected}, got {value!r}.")


def _is_number(value: object) -> bool:
    if isinstance(value, bool) or not isinstance(value, (int, float)):
        return False
    # Nothing that a rig measures comes near this; squares of larger numbers overflow.
    return -_LARGEST <= value <= _LARGEST
