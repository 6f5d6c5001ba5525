"""Changes of parameters that can be undone and redone."""

from collections.abc import Mapping
from typing import Any

from app.analysis.comparison import A, B, Comparison
from estimator import Parameters, changed, values_of

_DRAG = 1.0  # seconds; changes of the same parameter closer together than this are one change
_SIZE = 200
_NOTHING: tuple[frozenset[str], float] = (frozenset(), -_DRAG)


class ParameterHistory:
    """Changes, one entry per drag of a slider; each is {name: the value to go back to}."""

    def __init__(self) -> None:
        self._undo: list[Mapping[str, Any]] = []
        self._redo: list[Mapping[str, Any]] = []
        self._last = _NOTHING  # names that changed last, and when

    def note(self, before: Parameters, after: Parameters, now: float | None) -> None:
        """Remember a change.

        Args:
            before: the parameters before it.
            after: the parameters after it.
            now: seconds of any steady clock; None for what is no part of a drag, such as a reset.
        """
        change = _differences(before, after)
        if not change:
            return
        names = frozenset(change)
        last, then = self._last
        dragged = now is not None and last == names and now - then < _DRAG
        if not (self._undo and dragged):
            self._undo.append(change)
            del self._undo[:-_SIZE]
        self._redo.clear()
        self._last = _NOTHING if now is None else (names, now)

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
        after = changed(parameters, stack.pop())
        other.append(_differences(parameters, after))
        self._last = _NOTHING  # what follows is a change of its own
        return after


class ParameterHistories:
    """The changes of A, and those of B."""

    def __init__(self) -> None:
        self._sides = {A: ParameterHistory(), B: ParameterHistory()}

    def of(self, comparison: Comparison | None) -> ParameterHistory:
        """Those of the parameters that are edited."""
        return self._sides[comparison.edited if comparison else A]

    def compare(
        self,
        before: Comparison | None,
        edited_before: Parameters,
        after: Comparison | None,
        edited: Parameters,
    ) -> None:
        """Remember what another comparison changes: a copy replaces parameters, a switch does not.

        Args:
            before: the comparison before it.
            edited_before: the parameters that were edited in it.
            after: the comparison after it; without one, nothing of B is remembered.
            edited: the parameters that are edited now.
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
