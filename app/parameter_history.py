"""Changes of parameters that can be undone and redone."""

from collections.abc import Mapping
from dataclasses import asdict, replace
from typing import Any

from estimator import Parameters

_DRAG = 1.0  # seconds; changes of the same parameter closer together than this are one change
_SIZE = 200


class ParameterHistory:
    """What changed, one entry per drag of a slider; each is {name: the value to go back to}."""

    def __init__(self) -> None:
        self._undo: list[Mapping[str, Any]] = []
        self._redo: list[Mapping[str, Any]] = []
        self._last: tuple[frozenset[str], float] = (frozenset(), -_DRAG)

    def note(self, before: Parameters, after: Parameters, now: float) -> None:
        """Remember a change that was made at `now` (seconds of any steady clock)."""
        change = _differences(before, after)
        if not change:
            return
        names = frozenset(change)
        if not (self._undo and self._last[0] == names and now - self._last[1] < _DRAG):
            self._undo.append(change)
            del self._undo[:-_SIZE]
        self._redo.clear()
        self._last = (names, now)

    def undo(self, parameters: Parameters) -> Parameters | None:
        """The parameters before the last change, None where there is none."""
        return self._go(parameters, self._undo, self._redo)

    def redo(self, parameters: Parameters) -> Parameters | None:
        """The parameters after the change that was undone last, None where there is none."""
        return self._go(parameters, self._redo, self._undo)

    def _go(
        self, parameters: Parameters, stack: list[Mapping[str, Any]], other: list[Mapping[str, Any]]
    ) -> Parameters | None:
        if not stack:
            return None
        changed = replace(parameters, **stack.pop())
        other.append(_differences(parameters, changed))
        self._last = (frozenset(), -_DRAG)  # what follows is a change of its own
        return changed


def _differences(before: Parameters, after: Parameters) -> dict[str, Any]:
    """{name: value before} of the parameters that differ."""
    new = asdict(after)
    return {name: value for name, value in asdict(before).items() if value != new[name]}
