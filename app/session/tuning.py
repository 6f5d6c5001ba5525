"""Edited parameters with comparison, history and refused entries."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace
from typing import Any

from app.analysis.comparison import Comparison
from app.session.history import ParameterHistories
from estimator import ParameterError, Parameters, changed, values_of


@dataclass(frozen=True)
class Refusal:
    """Refused entry of a parameter's value.

    Attributes:
        reason: a sentence.
        clamped: whether the browser has since clamped it to an end of the slider: the control must
            then show the value in use, and the reason stays readable for a while.
    """

    reason: str
    clamped: bool = False


class Tuning:
    """Parameters, their comparison and their history.

    Args:
        parameters: initial ones.
        defaults: that a reset restores.

    Attributes:
        parameters: the edited ones.
        comparison: with a second set of parameters, None without one.
        refusals: {parameter: its refused entry}, the latest last.
        revision: incremented when parameters change other than by their controls.
    """

    def __init__(self, parameters: Parameters, defaults: Parameters) -> None:
        self.parameters = parameters
        self.comparison: Comparison | None = None
        self.refusals: dict[str, Refusal] = {}
        self.revision = 0
        self._defaults = defaults
        self._histories = ParameterHistories()

    def enter(self, values: Mapping[str, Any], at_end: Iterable[str], now: float) -> None:
        """Apply values of controls, {parameter: value}, or refuse all of them.

        When a slider's field loses the focus, the browser clamps a refused value to the slider's
        range. The clamped value is not the user's entry and is not applied.

        Args:
            values: as entered.
            at_end: names of those at an end of their slider.
            now: seconds of a monotonic clock.
        """
        for name in at_end:
            refusal = self.refusals.get(name)
            if refusal is not None and not refusal.clamped:
                self.refusals[name] = replace(refusal, clamped=True)
                values = {other: value for other, value in values.items() if other != name}
        if not values:
            return
        try:
            after = changed(self.parameters, values)
        except ParameterError as error:
            for name in values:
                self.refusals.pop(name, None)
                self.refusals[name] = Refusal(str(error))
            return
        self._histories.of(self.comparison).note(self.parameters, after, now)
        self.parameters = after
        self.refusals.clear()

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
        self.refusals.clear()
        self.revision += 1
