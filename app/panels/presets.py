"""Presets: parameters saved under names or in files."""

import time
from dataclasses import dataclass
from typing import Literal

import viser
from viser import Icon

from app.analysis.parameter_files import from_text, to_text
from app.browser.controls import show_value
from app.errors import InputError
from app.panels.panel import Panel, PanelContext
from app.panels.triggers import post_chosen, post_on
from app.session.command import LatestWins
from app.session.outbox import Download, Notice
from app.session.presets import Presets, PresetUse, preset_folder
from app.session.snapshot import Status
from app.session.workbench import Workbench
from estimator import Parameters

_NONE: str = "(none saved yet)"
_USES: dict[str, Literal["load", "delete"]] = {"Load": "load", "Delete": "delete"}
_AGE = 2.0  # seconds after which the list is refreshed
_LARGEST = 100_000  # maximum bytes of a parameter file


@dataclass(frozen=True)
class SaveParameters(LatestWins):
    """Save the parameters as a file for the command line."""

    def apply(self, workbench: Workbench) -> None:
        """Put the file into the outbox."""
        content = to_text(workbench.tuning.parameters).encode()
        workbench.outbox.append(Download("parameters.json", content))


@dataclass(frozen=True)
class OpenParameters(LatestWins):
    """Load the parameters of an uploaded file."""

    name: str
    content: bytes

    def apply(self, workbench: Workbench) -> None:
        """Load them; InputError if the file is invalid."""
        if len(self.content) > _LARGEST:
            raise InputError(f"{self.name} is too large for a parameter file.")
        try:
            text = self.content.decode()
        except UnicodeDecodeError as error:
            raise InputError(
                f"{self.name} is not a text file, so it cannot be a parameter file."
            ) from error
        workbench.tuning.set(from_text(text, self.name))


@dataclass(frozen=True)
class UsePreset(LatestWins):
    """Load, save or delete a preset."""

    action: Literal["load", "save", "delete"]
    name: str

    def apply(self, workbench: Workbench) -> None:
        """Run the action; InputError if it fails."""
        presets, done = Presets(preset_folder()), False
        try:
            match self.action:
                case "load":
                    workbench.tuning.set(presets.load(self.name))
                case "save":
                    workbench.outbox.append(_saved(presets, self.name, workbench.tuning.parameters))
                case "delete":
                    presets.delete(self.name)
            done = True
        finally:
            workbench.preset_use = PresetUse(self.action, self.name, done)


def _saved(presets: Presets, name: str, parameters: Parameters) -> Notice:
    if not name:
        raise InputError("Type a name first, under which the parameters are saved.")
    was = " was there already; it" if name in presets.names() else ""
    presets.save(name, parameters)
    return Notice("Preset saved", f"{name}{was} holds these parameters now.", replaces=True)


class PresetsPanel(Panel):
    """Controls to save, load and delete presets and files."""

    def __init__(self, context: PanelContext) -> None:
        gui, post = context.client.gui, context.post
        self._presets = Presets(preset_folder())
        self._listed_at = -_AGE
        self._use: PresetUse | None = None
        with gui.add_folder("Presets", expand_by_default=False):
            self._list: viser.GuiDropdownHandle[str] = gui.add_dropdown(
                "Preset", [_NONE], hint=f"Parameters that were saved in {preset_folder()}."
            )
            uses = gui.add_button_group("", tuple(_USES))
            self._name = gui.add_text("Name", "", hint="Under which Save keeps the parameters.")
            saves = gui.add_button_group("", ("Save",))
            save = gui.add_button(
                "Save as a file",
                icon=Icon.DOWNLOAD,
                color="gray",
                hint="A file for --parameters of the command line.",
            )
            self._upload = gui.add_upload_button(
                "Open a file",
                icon=Icon.UPLOAD,
                color="gray",
                mime_type="application/json",
                hint="A parameter file, as Save as a file makes it.",
            )

        # Coroutines run at once, before the control's value can change again.
        @uses.on_click
        async def _(_: viser.GuiEvent) -> None:
            if (name := self._list.value) != _NONE:
                post_chosen(post, uses, _USES, lambda action: UsePreset(action, name))

        @saves.on_click
        async def _(_: viser.GuiEvent) -> None:
            post(UsePreset("save", self._name.value.strip()))

        entry = gui.add_command("Save parameters as a file", icon=Icon.DOWNLOAD)
        post_on(post, SaveParameters(), save, entry)

        @self._upload.on_upload
        async def _(_: viser.GuiEvent) -> None:
            file = self._upload.value
            post(OpenParameters(file.name, file.content))

    def announce(self, status: Status) -> None:
        """Refresh the list, which other sessions change, too."""
        use, chosen = status.preset_use, self._list.value
        used, self._use = use is not self._use, use
        if used and use is not None and use.done:
            if use.action == "load":
                self._name.value = use.name
            elif use.action == "save":
                chosen = use.name
        if used or time.monotonic() > self._listed_at + _AGE:
            self._show(chosen)

    def _show(self, chosen: str) -> None:
        names = tuple(self._presets.names()) or (_NONE,)
        self._listed_at = time.monotonic()
        if names != self._list.options:
            self._list.options = names
        show_value(self._list, chosen if chosen in names else names[0])
