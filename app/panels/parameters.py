"""The estimator's parameters: sliders for the paper's four, the method, the others folded."""

import time
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, fields
from html import escape
from typing import TYPE_CHECKING, Any, Self

import viser

from app.panels.panel import Desk, Panel, Shown
from app.session.commands import ChangeParameters, ResetParameters
from app.session.queue import Wish
from estimator import PARAMETER_INFO, Parameters, method_names

if TYPE_CHECKING:
    from app.session.workbench import Workbench

_READING = 4.0  # seconds for which a refusal is seen after the old value has come back
_UNSET = 0
"""What stands in a number field for a parameter that is unset."""

_DEFAULTS: dict[str, Any] = {field.name: field.default for field in fields(Parameters)}
_OPTIONAL = {name for name, default in _DEFAULTS.items() if default is None}


@dataclass(frozen=True)
class UndoParameters:
    """Undo this many changes, or redo where it is negative."""

    changes: int

    def after(self, earlier: Self) -> Self:
        """Both."""
        return type(self)(earlier.changes + self.changes)

    def fulfil(self, workbench: "Workbench") -> None:
        """Go through the history."""
        workbench.undo_parameters(self.changes)


class ParametersPanel(Panel):
    """Change parameters; what is out of range is refused in words."""

    def __init__(self, desk: Desk) -> None:
        gui, parameters, post = desk.client.gui, desk.parameters, desk.post
        self._controls: dict[str, Any] = {}
        self._refused: set[str] = set()
        self._read_at = 0.0
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

    def show(self, shown: Shown) -> None:
        """Say whose parameters these are, where two sets are compared."""
        compared = shown.comparison
        self._folder.label = f"Parameters of {compared.edited}" if compared else "Parameters"
        if not self._refused and time.monotonic() > self._read_at:
            self._refusal.visible = False

    def replace(self, parameters: Parameters) -> None:
        """Show these parameters, and that nothing is refused."""
        self._refused = set(self._controls)
        self.accept(parameters)

    def meant(self, values: Mapping[str, Any], parameters: Parameters) -> dict[str, Any]:
        """Which of these values a person wants.

        When a slider's field loses the focus, the browser puts what was refused to the nearest
        value that the slider offers. Nobody asked for that: it shows again what is in use.
        """
        clamped = {
            name
            for name in self._refused & set(values)
            if isinstance(control := self._controls[name], viser.GuiSliderHandle)
            and values[name] in (control.min, control.max)
        }
        for name in clamped:
            self._show(name, parameters)
        self._refused -= clamped
        if clamped:
            self._read_at = time.monotonic() + _READING
        return {name: value for name, value in values.items() if name not in clamped}

    def accept(self, parameters: Parameters) -> None:
        """Show that a change was taken.

        Only controls whose value was refused are set: a person may be moving the others.
        """
        for name in self._sliders:
            # More than a slider offers may be typed, or come from a file.
            self._controls[name].max = max(self._controls[name].max, getattr(parameters, name))
        for name in self._refused:
            self._show(name, parameters)
        self._refused.clear()
        self._refusal.visible = False

    def _show(self, name: str, parameters: Parameters) -> None:
        value = getattr(parameters, name)
        self._controls[name].value = _UNSET if value is None else value

    def refuse(self, names: Iterable[str], reason: str) -> None:
        """Say why values are not taken; the controls stay, so that a person can go on typing."""
        self._refused.update(names)
        self._refusal.content = (
            '<div style="font-size: 0.8rem; padding: 0 1em; color: #c92a2a" role="alert">'
            f"{escape(reason)}</div>"
        )
        self._refusal.visible = True

    def _connect(self, name: str, post: Callable[[Wish], None]) -> None:
        # Coroutines run at once, before anything can change a control's value again.
        @self._controls[name].on_update
        async def _(event: viser.GuiEvent) -> None:
            if event.client_id is not None:
                value = self._controls[name].value
                unset = name in _OPTIONAL and value == _UNSET
                post(ChangeParameters({name: None if unset else value}))


def _add_commands(gui: viser.GuiApi, post: Callable[[Wish], None]) -> None:
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
