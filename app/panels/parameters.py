"""Controls of the estimator's parameters."""

import time
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from html import escape
from typing import Any, Self

import viser

from app.browser.controls import show_value
from app.panels.panel import Panel, PanelContext
from app.panels.parameter_controls import (
    add_control,
    entered_value,
    label_of,
    shown_value,
)
from app.panels.triggers import post_on
from app.session.command import Command
from app.session.commands import ChangeParameters, ResetParameters
from app.session.snapshot import Snapshot, Status
from app.session.tuning import Refusal
from app.session.workbench import Workbench
from estimator import PARAMETER_INFO, ParameterInfo, all_methods, find_method, values_of

_READING = 4.0  # seconds to show a refusal after the old value was restored


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


class ParametersPanel(Panel):
    """Controls of the method's parameters; values out of range are refused with a reason."""

    def __init__(self, context: PanelContext) -> None:
        gui, post = context.client.gui, context.post
        self._infos = {"method": PARAMETER_INFO["method"], **_all_infos()}
        self._controls: dict[str, Any] = {}
        self._refused: set[str] = set()  # parameters whose controls hold a refused value
        self._clamped: set[str] = set()
        self._readable_until = 0.0
        self._revision = 0
        self._method: str | None = None
        self._resets: dict[str, frozenset[str]] = {"All": frozenset(self._infos)}
        sliders = [name for name, info in self._infos.items() if info.slider]
        values = values_of(context.parameters)
        self._folder = gui.add_folder("Parameters")
        with self._folder:
            for name in (*sliders, "method"):
                self._controls[name] = add_control(gui, name, self._infos[name], values[name])
            self._refusal = gui.add_html("", visible=False)
            self._more = gui.add_folder("More parameters", expand_by_default=False)
            with self._more:
                folded = frozenset(self._infos) - self._controls.keys()
                for name in (name for name in self._infos if name in folded):
                    self._controls[name] = add_control(gui, name, self._infos[name], values[name])
                reset_folded = gui.add_button(
                    "Reset these",
                    icon=viser.Icon.RESTORE,
                    color="gray",
                    hint="To what the app was started with.",
                )
            self._reset = gui.add_button_group(
                "Reset", tuple(self._resets), hint="To what the app was started with."
            )
            history = gui.add_button_group(
                "History", ("Undo", "Redo"), hint="Of the parameters. Keys: Ctrl+Z, Ctrl+Shift+Z."
            )

        for name in self._controls:
            self._connect(name, post)

        @self._reset.on_click
        async def _(_: viser.GuiEvent) -> None:
            post(ResetParameters(self._resets.get(self._reset.value, frozenset())))

        @history.on_click
        async def _(_: viser.GuiEvent) -> None:
            post(UndoParameters(1 if history.value == "Undo" else -1))

        post_on(post, ResetParameters(folded), reset_folded)
        _add_commands(gui, frozenset(self._infos), post)
        self._show_controls(context.parameters.method)

    def show(self, snapshot: Snapshot) -> None:
        """Name the edited side, A or B, in the folder's title."""
        compared = snapshot.comparison
        self._folder.label = f"Parameters of {compared.edited}" if compared else "Parameters"

    def announce(self, status: Status) -> None:
        """Show values that were set other than by their controls, and refusals.

        Other controls are left alone, since the user may be moving them. A refused value stays in
        its control, so that the user can go on typing, until it is accepted, clamped or replaced.
        """
        values = values_of(status.parameters)
        for name, control in self._controls.items():
            if self._infos[name].slider:
                # Typed or loaded values may exceed the slider's range.
                control.max = max(control.max, values[name])
                control.min = min(control.min, values[name])
        refused = {name for name, refusal in status.refusals.items() if not refusal.clamped}
        anew = status.parameters_revision != self._revision
        for name in self._controls if anew else self._refused - refused:
            show_value(self._controls[name], shown_value(values[name]))
        self._refused, self._revision = refused, status.parameters_revision
        self._show_controls(status.parameters.method)
        self._show_refusal(status.refusals)

    def _show_controls(self, method: str) -> None:
        """Show the controls of a method's parameters, and hide all others."""
        if method == self._method:
            return
        self._method = method
        used = find_method(method).infos()
        for name, control in self._controls.items():
            control.visible = name in used or name == "method"
        self._more.visible = any(not info.slider for info in used.values())
        sliders = [name for name in self._controls if name in used and used[name].slider]
        self._resets = {label_of(name, used[name]): frozenset([name]) for name in sliders}
        self._resets["All"] = frozenset(self._infos)
        self._reset.options = tuple(self._resets)

    def _show_refusal(self, refusals: Mapping[str, Refusal]) -> None:
        clamped = {name for name, refusal in refusals.items() if refusal.clamped}
        if clamped - self._clamped:
            self._readable_until = time.monotonic() + _READING
        self._clamped = clamped
        reading = bool(clamped) and time.monotonic() < self._readable_until
        self._refusal.visible = len(clamped) < len(refusals) or reading
        if refusals:
            *_, last = refusals.values()
            self._refusal.content = (
                '<div style="font-size: 0.8rem; padding: 0 1em; color: #c92a2a" role="alert">'
                f"{escape(last.reason)}</div>"
            )

    def _connect(self, name: str, post: Callable[[Command], None]) -> None:
        # Coroutines run at once, before the control's value can change again.
        @self._controls[name].on_update
        async def _(event: viser.GuiEvent) -> None:
            if event.client_id is not None:
                control = self._controls[name]
                value = entered_value(control, self._infos[name])
                slides = isinstance(control, viser.GuiSliderHandle)
                at_end = slides and value in (control.min, control.max)
                post(ChangeParameters({name: value}, frozenset([name] if at_end else [])))


def _all_infos() -> dict[str, ParameterInfo]:
    """{name: description} of all methods' parameters, shared ones first."""
    shared = {name: info for name, info in PARAMETER_INFO.items() if name != "method"}
    return shared | {n: info for method in all_methods() for n, info in method.infos().items()}


def _add_commands(
    gui: viser.GuiApi, names: frozenset[str], post: Callable[[Command], None]
) -> None:
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
    post_on(post, ResetParameters(names), reset)
