"""Edited parameters with comparison, history and corrected entries."""

from collections.abc import Iterable, Mapping
from typing import Any

from app.analysis.comparison import Comparison
from app.session.history import ParameterHistories
from estimator import (
    PARAMETER_INFO,
    ParameterError,
    ParameterInfo,
    Parameters,
    changed,
    find_method,
    values_of,
)

Ends = tuple[float, float]


class Tuning:
    """Parameters, their comparison and their history.

    Args:
        parameters: initial ones.
        defaults: that a reset restores.

    Attributes:
        parameters: the edited ones.
        comparison: with a second set of parameters, None without one.
        corrections: {parameter: what became of its entry, a sentence} of the last entries.
        corrected: number of corrections so far.
        revision: incremented when parameters change other than by their controls.
    """

    def __init__(self, parameters: Parameters, defaults: Parameters) -> None:
        self.parameters = parameters
        self.comparison: Comparison | None = None
        self.corrections: dict[str, str] = {}
        self.corrected = 0
        self.revision = 0
        self._held = False
        self._defaults = defaults
        self._histories = ParameterHistories()

    def hold(self, held: bool) -> None:
        """A slider is pressed or released: what is entered in between is undone as one."""
        self._held = held
        self._histories.of(self.comparison).separate()

    def enter(self, values: Mapping[str, Any], ranges: Mapping[str, Ends], now: float) -> None:
        """Apply values of controls, {parameter: value}; a number beyond its range becomes an end.

        When a field loses the focus, the browser sends such an end, too: what was said of the entry
        then stays.

        Args:
            values: as entered.
            ranges: {parameter: (smallest, largest)} of their controls.
            now: seconds of a monotonic clock.
        """
        nearest = {name: _nearest(value, ranges.get(name)) for name, value in values.items()}
        said = {
            name: _sentence(name, values[name], nearest[name], ranges[name])
            for name in values
            if nearest[name] != values[name]
        }
        try:
            after = changed(self.parameters, {n: _parameter(n, v) for n, v in nearest.items()})
        except ParameterError as error:
            said, after = dict.fromkeys(values, str(error)), self.parameters
        if after == self.parameters and not said:
            return
        self.corrections = said
        self.corrected += len(said)
        if after != self.parameters:
            self._histories.of(self.comparison).note(self.parameters, after, now, held=self._held)
            self.parameters = after

    def set(self, parameters: Parameters) -> None:
        """Replace the parameters, as one change."""
        self._histories.of(self.comparison).note(self.parameters, parameters, None)
        self._replace(parameters)

    def reset(self, names: Iterable[str]) -> None:
        """Reset parameters to the defaults."""
        defaults = values_of(self._defaults)
        self.set(changed(self.parameters, {name: defaults[name] for name in names}))

    def undo(self, changes: int) -> None:
        """Undo this many changes, or redo them if negative."""
        history, parameters = self._histories.of(self.comparison), self.parameters
        step = history.undo if changes > 0 else history.redo
        for _ in range(abs(changes)):
            parameters = step(parameters) or parameters
        self._replace(parameters)

    def compare(self, comparison: Comparison | None, edited: Parameters) -> None:
        """Set the comparison, None for none, and the edited parameters."""
        self._histories.compare(self.comparison, self.parameters, comparison, edited)
        self.comparison = comparison
        self._replace(edited)

    def _replace(self, parameters: Parameters) -> None:
        self.parameters = parameters
        self.corrections.clear()
        self.revision += 1


def _nearest(value: Any, ends: Ends | None) -> Any:  # noqa: ANN401 (of any parameter)
    if ends is None or isinstance(value, bool) or not isinstance(value, int | float):
        return value
    low, high = (type(value)(end) if abs(end) < float("inf") else end for end in ends)
    return min(max(value, low), high)


def _parameter(name: str, number: Any) -> Any:  # noqa: ANN401
    """The value that a control's number stands for: below the smallest, an unset one."""
    info = _info(name)
    unset = info.optional and isinstance(number, int | float) and number < info.low
    return None if unset else number


def _sentence(name: str, entered: float, used: float, ends: Ends) -> str:
    info = _info(name)
    unit = f" {info.unit}" if info.unit else ""
    title = info.symbol or name.replace("_", " ")
    return f"{title} goes from {ends[0]:g} to {ends[1]:g}{unit}: {entered:g} became {used:g}."


def _info(name: str) -> ParameterInfo:
    method = name.rpartition(".")[0]
    return find_method(method).infos()[name] if method else PARAMETER_INFO[name]
