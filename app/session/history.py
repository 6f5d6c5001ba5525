"""Undo and redo of parameter changes."""

from collections.abc import Mapping
from typing import Any

from app.analysis.comparison import A, B, Comparison
from estimator import Parameters, changed, values_of

_DRAG = 1.0  # seconds; closer changes of the same parameter count as one
_SIZE = 200
_NOTHING: tuple[frozenset[str], float] = (frozenset(), -_DRAG)


class ParameterHistory:
    """Undo and redo stacks of {name: value to restore}, one entry per drag of a slider."""

    def __init__(self) -> None:
        self._undo: list[Mapping[str, Any]] = []
        self._redo: list[Mapping[str, Any]] = []
        self._last = _NOTHING  # names of the last change, and its time

    def separate(self) -> None:
        """Let the next change begin an entry of its own."""
        self._last = _NOTHING

    def note(
        self, before: Parameters, after: Parameters, now: float | None, *, held: bool = False
    ) -> None:
        """Record a change.

        Args:
            before: the parameters before it.
            after: the parameters after it.
            now: seconds of a monotonic clock; None for a change outside drags, such as a reset.
            held: whether a slider is still pressed since the last change, however long ago.
        """
        change = _differences(before, after)
        if not change:
            return
        names = frozenset(change)
        last, then = self._last
        dragged = now is not None and last == names and (held or now - then < _DRAG)
        if not (self._undo and dragged):
            self._undo.append(change)
            del self._undo[:-_SIZE]
        self._redo.clear()
        self._last = _NOTHING if now is None else (names, now)

    def undo(self, parameters: Parameters) -> Parameters | None:
        """The parameters before the last change, None without one."""
        return self._go(parameters, self._undo, self._redo)

    def redo(self, parameters: Parameters) -> Parameters | None:
        """The parameters after the change undone last, None without one."""
        return self._go(parameters, self._redo, self._undo)

    def _go(
        self, parameters: Parameters, stack: list[Mapping[str, Any]], other: list[Mapping[str, Any]]
    ) -> Parameters | None:
        if not stack:
            return None
        after = changed(parameters, stack.pop())
        other.append(_differences(parameters, after))
        self.separate()
        return after


class ParameterHistories:
    """Histories of A and of B."""

    def __init__(self) -> None:
        self._sides = {A: ParameterHistory(), B: ParameterHistory()}

    def of(self, comparison: Comparison | None) -> ParameterHistory:
        """History of the edited side."""
        return self._sides[comparison.edited if comparison else A]

    def compare(
        self,
        before: Comparison | None,
        edited_before: Parameters,
        after: Comparison | None,
        edited: Parameters,
    ) -> None:
        """Record a change of comparison: a copy replaces parameters, a switch does not.

        Args:
            before: the comparison before the change.
            edited_before: the edited parameters before the change.
            after: the comparison after the change; None clears the history of B.
            edited: the edited parameters after the change.
        """
        if after is None:
            self._sides[B] = ParameterHistory()
        elif before is not None:
            replaced = edited_before if before.edited == after.edited else before.other
            self._sides[after.edited].note(replaced, edited, None)


def _differences(before: Parameters, after: Parameters) -> dict[str, Any]:
    """{name: value before} of the parameters that differ."""
    new = values_of(after)
    return {name: value for name, value in values_of(before).items() if value != new[name]}
