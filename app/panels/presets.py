"""Parameters under names and in files: saved, loaded, deleted."""

import time
from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING

import viser
from viser import Icon

from app.analysis.parameter_files import from_text, to_text
from app.browser.controls import show_value
from app.errors import InputError
from app.panels.panel import Desk, Panel, Shown
from app.session.commands import LatestWins
from app.session.presets import Presets, preset_folder

if TYPE_CHECKING:
    from app.session.workbench import Workbench

_NONE: str = "(none saved yet)"
_AGE = 2.0  # seconds after which they are listed again
_LARGEST = 100_000  # bytes of a file of parameters


@dataclass(frozen=True)
class SaveParameters(LatestWins):
    """Save the parameters as a file that the command line takes."""

    def fulfil(self, workbench: "Workbench") -> None:
        """Send the file to the browser."""
        content = to_text(workbench.parameters).encode()
        workbench.client.send_file_download("parameters.json", content, save_immediately=True)


@dataclass(frozen=True)
class OpenParameters(LatestWins):
    """Take the parameters of a file."""

    name: str
    content: bytes

    def fulfil(self, workbench: "Workbench") -> None:
        """Take them, or say why not."""
        if len(self.content) > _LARGEST:
            raise InputError(f"{self.name} is too large for a file of parameters.")
        try:
            text = self.content.decode()
        except UnicodeDecodeError as error:
            raise InputError(f"{self.name} is no text, and so no file of parameters.") from error
        workbench.set_parameters(from_text(text, self.name))


@dataclass(frozen=True)
class UsePreset(LatestWins):
    """Do something with the preset of a name: load, save, or delete it."""

    panel: "PresetsPanel"
    action: str
    name: str

    def fulfil(self, workbench: "Workbench") -> None:
        """Do it, and show what there is afterwards."""
        self.panel.use(workbench, self.action, self.name)


class PresetsPanel(Panel):
    """A list of presets, a field for the name of another, and files."""

    def __init__(self, desk: Desk) -> None:
        gui, post = desk.client.gui, desk.post
        self._presets = Presets(preset_folder())
        self._listed_at = -_AGE
        self._actions: dict[str, Callable[[Workbench, str], None]] = {
            "Load": self._load,
            "Save": self._save,
            "Delete": self._delete,
        }
        with gui.add_folder("Presets", expand_by_default=False):
            self._list: viser.GuiDropdownHandle[str] = gui.add_dropdown(
                "Preset", [_NONE], hint=f"Parameters that were saved in {preset_folder()}."
            )
            uses = gui.add_button_group("", ("Load", "Delete"))
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
                hint="A file of parameters, as Save as a file makes it.",
            )

        # Coroutines run at once, before anything can change a control's value again.
        @uses.on_click
        async def _(_: viser.GuiEvent) -> None:
            post(UsePreset(self, uses.value, self._list.value))

        @saves.on_click
        async def _(_: viser.GuiEvent) -> None:
            post(UsePreset(self, "Save", self._name.value.strip()))

        @save.on_click
        async def _(_: viser.GuiEvent) -> None:
            post(SaveParameters())

        command = gui.add_command("Save parameters as a file", icon=Icon.DOWNLOAD)

        @command.on_trigger
        async def _(_: viser.CommandEvent) -> None:
            post(SaveParameters())

        @self._upload.on_upload
        async def _(_: viser.GuiEvent) -> None:
            file = self._upload.value
            post(OpenParameters(file.name, file.content))

    def show(self, shown: Shown) -> None:
        """List what is there now: other sessions save and delete, too."""
        if time.monotonic() > self._listed_at + _AGE:
            self._show(self._list.value)

    def use(self, workbench: "Workbench", action: str, name: str) -> None:
        """Load, save or delete a preset; InputError says why it cannot be."""
        if name == _NONE:
            return
        try:
            self._actions[action](workbench, name)
        finally:
            self._show(self._list.value)

    def _load(self, workbench: "Workbench", name: str) -> None:
        workbench.set_parameters(self._presets.load(name))
        self._name.value = name

    def _save(self, workbench: "Workbench", name: str) -> None:
        if not name:
            raise InputError("Type a name first, under which the parameters are saved.")
        replaced = name in self._presets.names()
        self._presets.save(name, workbench.parameters)
        self._show(name)
        was = " was there already; it" if replaced else ""
        workbench.page.say("Preset saved", f"{name}{was} holds these parameters now.")

    def _delete(self, workbench: "Workbench", name: str) -> None:
        del workbench
        self._presets.delete(name)

    def _show(self, chosen: str) -> None:
        names = tuple(self._presets.names()) or (_NONE,)
        self._listed_at = time.monotonic()
        if names != self._list.options:
            self._list.options = names
        show_value(self._list, chosen if chosen in names else names[0])
