"""The estimator's parameters: sliders for the paper's four, the method, the others folded."""

import time
from collections.abc import Callable, Mapping
from dataclasses import dataclass, fields
from html import escape
from typing import Any, Self

import viser

from app.browser.controls import show_value
from app.panels.panel import Panel, PanelContext
from app.session.command import Command
from app.session.commands import ChangeParameters, ResetParameters
from app.session.snapshot import Snapshot, Status
from app.session.tuning import Refusal
from app.session.workbench import Workbench
from estimator import PARAMETER_INFO, Parameters, method_names

_READING = 4.0  # seconds for which a refusal is seen after the old value has come back
_UNSET = 0
"""Number in the field of a parameter that is unset."""

_DEFAULTS: dict[str, Any] = {field.name: field.default for field in fields(Parameters)}
_OPTIONAL = {name for name, default in _DEFAULTS.items() if default is None}


@dataclass(frozen=True)
class UndoParameters:
    """Undo this many changes, or redo where it is negative."""

    changes: int

    def merged_with(self, earlier: Self) -> Self:
        """Both."""
        return type(self)(earlier.changes + self.changes)

    def apply(self, workbench: Workbench) -> None:
        """Go through the history."""
        workbench.tuning.undo(self.changes)


class ParametersPanel(Panel):
    """Controls of all parameters; values out of range are refused in words."""

    def __init__(self, context: PanelContext) -> None:
        gui, parameters, post = context.client.gui, context.parameters, context.post
        self._controls: dict[str, Any] = {}
        self._refused: set[str] = set()  # parameters in whose controls a refused value stands
        self._put_back: set[str] = set()
        self._readable_until = 0.0
        self._revision = 0
        self._sliders = [name for name, info in PARAMETER_INFO.items() if info.slider]
        self._folder = gui.add_folder("Parameters")
        with self._folder:
            for name in self._sliders:
                self._controls[name] = _add_slider(gui, name, getattr(parameters, name))
            self._controls["method"] = _add_field(gui, "method", parameters.method)
            self._refusal = gui.add_html("", visible=False)
            with gui.add_folder("More parameters", expand_by_default=False):
                for name in _DEFAULTS:
                    if name not in self._controls:
                        self._controls[name] = _add_field(gui, name, getattr(parameters, name))
                folded = frozenset(self._controls) - {*self._sliders, "method"}
                reset_folded = gui.add_button(
                    "Reset these",
                    icon=viser.Icon.RESTORE,
                    color="gray",
                    hint="To what the app was started with.",
                )
            resets = {PARAMETER_INFO[name].symbol: [name] for name in self._sliders}
            resets["All"] = [*_DEFAULTS]
            reset = gui.add_button_group(
                "Reset", tuple(resets), hint="To what the app was started with."
            )
            history = gui.add_button_group(
                "History", ("Undo", "Redo"), hint="Of the parameters. Keys: Ctrl+Z, Ctrl+Shift+Z."
            )

        for name in self._controls:
            self._connect(name, post)

        @reset.on_click
        async def _(_: viser.GuiEvent) -> None:
            post(ResetParameters(frozenset(resets[reset.value])))

        @reset_folded.on_click
        async def _(_: viser.GuiEvent) -> None:
            post(ResetParameters(folded))

        @history.on_click
        async def _(_: viser.GuiEvent) -> None:
            post(UndoParameters(1 if history.value == "Undo" else -1))

        _add_commands(gui, post)

    def show(self, snapshot: Snapshot) -> None:
        """Say whose parameters these are, where two sets are compared."""
        compared = snapshot.comparison
        self._folder.label = f"Parameters of {compared.edited}" if compared else "Parameters"

    def announce(self, status: Status) -> None:
        """Show values that something else has set, and say what is refused.

        Other controls are not set: a person may be moving them. A refused value stays in its
        control, so that a person can go on typing, until it is taken, put back or replaced.
        """
        for name in self._sliders:
            # More than a slider offers may be typed, or come from a file.
            control = self._controls[name]
            control.max = max(control.max, getattr(status.parameters, name))
        refused = {name for name, refusal in status.refusals.items() if not refusal.put_back}
        anew = status.parameters_revision != self._revision
        for name in self._controls if anew else self._refused - refused:
            value = getattr(status.parameters, name)
            show_value(self._controls[name], _UNSET if value is None else value)
        self._refused, self._revision = refused, status.parameters_revision
        self._say(status.refusals)

    def _say(self, refusals: Mapping[str, Refusal]) -> None:
        put_back = {name for name, refusal in refusals.items() if refusal.put_back}
        if put_back - self._put_back:
            self._readable_until = time.monotonic() + _READING
        self._put_back = put_back
        reading = bool(put_back) and time.monotonic() < self._readable_until
        self._refusal.visible = len(put_back) < len(refusals) or reading
        if refusals:
            *_, last = refusals.values()
            self._refusal.content = (
                '<div style="font-size: 0.8rem; padding: 0 1em; color: #c92a2a" role="alert">'
                f"{escape(last.reason)}</div>"
            )

    def _connect(self, name: str, post: Callable[[Command], None]) -> None:
        # Coroutines run at once, before anything can change a control's value again.
        @self._controls[name].on_update
        async def _(event: viser.GuiEvent) -> None:
            if event.client_id is not None:
                control = self._controls[name]
                value = None if name in _OPTIONAL and control.value == _UNSET else control.value
                slides = isinstance(control, viser.GuiSliderHandle)
                at_end = slides and value in (control.min, control.max)
                post(ChangeParameters({name: value}, frozenset([name] if at_end else [])))


def _add_commands(gui: viser.GuiApi, post: Callable[[Command], None]) -> None:
    undo = gui.add_command(
        "Undo parameters", hotkey="Z", modifier="cmd/ctrl", icon=viser.Icon.ARROW_BACK_UP
    )
    redo = gui.add_command(
        "Redo parameters",
        hotkey="Z",
        modifier="cmd/ctrl+shift",
        icon=viser.Icon.ARROW_FORWARD_UP,
    )
    reset = gui.add_command("Reset all parameters", icon=viser.Icon.RESTORE)

    # Coroutines run at once, so that keys are taken in their order.
    @undo.on_trigger
    async def _(_: viser.CommandEvent) -> None:
        post(UndoParameters(1))

    @redo.on_trigger
    async def _(_: viser.CommandEvent) -> None:
        post(UndoParameters(-1))

    @reset.on_trigger
    async def _(_: viser.CommandEvent) -> None:
        post(ResetParameters(frozenset(_DEFAULTS)))


def _add_slider(gui: viser.GuiApi, name: str, value: float) -> Any:  # noqa: ANN401 (viser's handles)
    info = PARAMETER_INFO[name]
    assert info.slider is not None
    low, high, step = info.slider
    kind = type(_DEFAULTS[name])
    # A flag may have asked for more than the slider offers.
    high = max(high, value)
    return gui.add_slider(
        info.symbol,
        min=kind(min(low, value)),
        max=kind(high),
        step=kind(step),
        initial_value=kind(value),
        marks=(
            (kind(low), f"{low:g}"),
            (kind(high), f"{high:g} m" if info.unit == "m" else f"{high:g}"),
        ),
        hint=_hint(name),
    )


def _add_field(gui: viser.GuiApi, name: str, value: Any) -> Any:  # noqa: ANN401 (of any parameter)
    # A label's column breaks longer words anywhere.
    label = name.replace("_", " ").replace("correspondence", "corresp.")
    if name == "method":
        return gui.add_dropdown(label, method_names(), initial_value=value, hint=_hint(name))
    if isinstance(_DEFAULTS[name], bool):
        return gui.add_checkbox(label, value, hint=_hint(name))
    # Without limits of its own, which would change what a person types without a word: what is out
    # of range is refused in words.
    return gui.add_number(
        label,
        initial_value=_UNSET if value is None else value,
        step=0.01 if isinstance(_DEFAULTS[name], float) else 1,
        hint=_hint(name) + (f" ({_UNSET}: unset)" if name in _OPTIONAL else ""),
    )


def _hint(name: str) -> str:
    info, default = PARAMETER_INFO[name], _DEFAULTS[name]
    said = f"{info.text} [{info.unit}]" if info.unit else info.text
    return said if default is None or isinstance(default, bool) else f"{said}; default {default}"
