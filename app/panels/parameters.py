"""Controls of the estimator's parameters: sliders and method first, all others elsewhere."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, Self

import numpy as np
import viser

from app.analysis.library import Opened
from app.browser.assets import call, run_asset
from app.browser.controls import show_value
from app.browser.internals import element_id
from app.browser.page_events import EventContent
from app.panels.panel import Panel, PanelContext
from app.panels.parameter_controls import (
    add_control,
    entered_value,
    label_of,
    range_of,
    rule_of,
    shown_value,
)
from app.panels.triggers import post_on
from app.session.command import Command, LatestWins
from app.session.commands import ChangeParameters, ResetParameters
from app.session.snapshot import Status
from app.session.workbench import Workbench
from estimator import PARAMETER_INFO, ParameterInfo, all_methods, find_method, values_of

_LONGEST = 1.35  # seconds: how far back n reaches at least, whatever the recording's rate


@dataclass(frozen=True)
class UndoParameters:
    """Undo this many changes, or redo them if negative."""

    changes: int

    def merged_with(self, earlier: Self) -> Self:
        """Add up the changes."""
        return type(self)(earlier.changes + self.changes)

    def apply(self, workbench: Workbench) -> None:
        """Undo or redo them."""
        workbench.tuning.undo(self.changes)


@dataclass(frozen=True)
class HoldSlider(LatestWins):
    """A slider is pressed, or released."""

    held: bool

    def apply(self, workbench: Workbench) -> None:
        """Let what is entered in between be one change."""
        workbench.tuning.hold(self.held)


class _Held(EventContent):
    held: bool


class _ControlsPanel(Panel):
    """Controls of some parameters; a number beyond its range becomes the nearest in it."""

    def __init__(self, context: PanelContext, infos: dict[str, ParameterInfo]) -> None:
        self._client, gui, self._infos = context.client, context.client.gui, infos
        self._controls: dict[str, Any] = {}
        self._ranges = {name: range_of(info) for name, info in infos.items()}
        self._revision = 0
        self._method: str | None = None
        self._rules: dict[str, str] = {}
        self._said: tuple[int, str, str] | None = None
        for name in ("number_fields.css", "number_fields.js"):
            run_asset(context.client, name)
        values = values_of(context.parameters)
        for name, info in infos.items():
            self._controls[name] = add_control(gui, name, info, values[name])
        for name in self._controls:
            self._connect(name, context.post)
        self._show_controls(context.parameters.method)

    def announce(self, status: Status) -> None:
        """Show values that were set other than by their controls, and what was corrected.

        Other controls are left alone, since the user may be moving them.
        """
        values = values_of(status.parameters)
        for name, control in self._controls.items():
            if self._infos[name].slider:
                self._fit(control, self._ranges[name], values[name])
        if status.parameters_revision != self._revision:
            self._revision = status.parameters_revision
            for name, control in self._controls.items():
                show_value(control, shown_value(values[name]))
        self._show_controls(status.parameters.method)
        self._say_rules()
        self._say_correction(status)

    def _fit(self, control: Any, ends: tuple[float, float], value: float) -> None:  # noqa: ANN401
        """Give a slider its range, wider only for as long as a value from elsewhere needs it."""
        low, high = min(ends[0], value), max(ends[1], value)
        if (control.min, control.max) != (low, high):
            control.min, control.max = low, high

    def _say_rules(self) -> None:
        """Let the page say what a field takes, while a person types into it."""
        for name, info in self._infos.items():
            if info.kind not in (int, float):
                continue
            rule = rule_of(info, self._ranges[name])
            if self._rules.get(name) != rule:
                self._rules[name] = rule
                element = element_id(self._controls[name])
                call(self._client, "fields.rule", element, rule, info.kind is int)

    def _say_correction(self, status: Status) -> None:
        """Say at its field what became of the last number that did not obey the rule."""
        before, self._said = self._said, None
        for name, sentence in status.corrections.items():
            if name in self._controls:
                self._said = status.corrected, name, sentence
        if self._said == before:
            return
        if before and (self._said is None or self._said[1] != before[1]):
            call(self._client, "fields.say", element_id(self._controls[before[1]]), "")
        if self._said:
            _, name, sentence = self._said
            call(self._client, "fields.say", element_id(self._controls[name]), sentence)

    def _show_controls(self, method: str) -> None:
        """Show the controls of a method's parameters, and hide all others."""
        if method == self._method:
            return
        self._method = method
        used = find_method(method).infos()
        for name, control in self._controls.items():
            control.visible = name in used or name == "method"

    def _connect(self, name: str, post: Callable[[Command], None]) -> None:
        # Coroutines run at once, before the control's value can change again.
        @self._controls[name].on_update
        async def _(event: viser.GuiEvent) -> None:
            if event.client_id is not None:
                control, info = self._controls[name], self._infos[name]
                ends = self._ranges[name]
                if info.slider:
                    ends = (float(control.min), float(control.max))
                post(ChangeParameters({name: entered_value(control, info)}, {name: ends}))


class ParametersPanel(_ControlsPanel):
    """The parameters that have sliders, and the method."""

    def __init__(self, context: PanelContext) -> None:
        sliders = {name: info for name, info in _all_infos().items() if info.slider}
        super().__init__(context, {**sliders, "method": PARAMETER_INFO["method"]})
        _add_commands(context.client.gui, context.post)
        run_asset(context.client, "presses.js")
        context.events.on("slider", _Held, lambda slider: context.post(HoldSlider(slider.held)))

    def open(self, opened: Opened) -> None:
        """Let n reach as far back as the recording and its rate suggest."""
        stamps, (low, high) = opened.recording.stamps, range_of(self._infos["n"])
        if len(stamps) > 1:
            high = max(high, round(_LONGEST / float(np.median(np.diff(stamps)))))
        self._ranges["n"] = (low, max(min(high, self._infos["n"].high, len(stamps) - 1), low + 1))


class MoreParametersPanel(_ControlsPanel):
    """The parameters without sliders; resets, undo and redo of all."""

    def __init__(self, context: PanelContext) -> None:
        gui, post, infos = context.client.gui, context.post, _all_infos()
        super().__init__(context, {name: info for name, info in infos.items() if not info.slider})
        self._resets: dict[str, frozenset[str]] = {}
        self._reset = gui.add_button_group(
            "Reset", ("all",), hint="To what the app was started with."
        )
        history = gui.add_button_group(
            "History", ("undo", "redo"), hint="Of the parameters. Keys: Ctrl+Z, Ctrl+Shift+Z."
        )
        self._show_resets(context.parameters.method)

        @self._reset.on_click
        async def _(_: viser.GuiEvent) -> None:
            post(ResetParameters(self._resets.get(self._reset.value, frozenset())))

        @history.on_click
        async def _(_: viser.GuiEvent) -> None:
            post(UndoParameters(1 if history.value == "undo" else -1))

    def announce(self, status: Status) -> None:
        """Show values, and a reset for each slider of the method."""
        super().announce(status)
        self._show_resets(status.parameters.method)

    def _show_resets(self, method: str) -> None:
        used = find_method(method).infos()
        sliders = {label_of(n, info): frozenset([n]) for n, info in used.items() if info.slider}
        resets = {**sliders, "others": frozenset(self._controls), "all": _all_names()}
        if resets != self._resets:
            self._resets = resets
            self._reset.options = tuple(resets)


def _all_infos() -> dict[str, ParameterInfo]:
    """{name: description} of all methods' parameters, shared ones first."""
    shared = {name: info for name, info in PARAMETER_INFO.items() if name != "method"}
    return shared | {n: info for method in all_methods() for n, info in method.infos().items()}


def _all_names() -> frozenset[str]:
    return frozenset(["method", *_all_infos()])


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
    post_on(post, UndoParameters(1), undo)
    post_on(post, UndoParameters(-1), redo)
    post_on(post, ResetParameters(_all_names()), reset)
