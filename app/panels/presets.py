"""Presets: parameters saved under names or in files."""

import time
from dataclasses import dataclass, replace

import viser
from viser import Icon

from app.analysis.parameter_files import from_text, to_text
from app.browser.controls import show_value
from app.errors import InputError
from app.panels.panel import Panel, PanelContext
from app.panels.triggers import post_chosen, post_on
from app.session.command import LatestWins
from app.session.outbox import Download, Notice
from app.session.presets import PresetAction, Presets, PresetUse, composed, preset_folder
from app.session.snapshot import Status
from app.session.workbench import Workbench

_NONE: str = "(none saved yet)"
_USES: dict[str, PresetAction] = {"Load": "load", "Delete": "delete"}
_NAMINGS = ("Save", "Rename")
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
    """Load, save, rename or delete a preset.

    What would replace or delete one asks first; the same once more is the answer.

    Attributes:
        action: what to do.
        name: of the preset.
        new_name: for renaming.
    """

    action: PresetAction
    name: str
    new_name: str = ""

    def apply(self, workbench: Workbench) -> None:
        """Run the action or ask; InputError if it fails."""
        presets, now = Presets(preset_folder()), time.monotonic()
        use = PresetUse(self.action, self.name, done=False)
        sure = use.confirms(workbench.preset_use, now)
        workbench.preset_use = use
        if not sure and (question := self._question(presets)):
            workbench.preset_use = replace(use, asked=now)
            workbench.outbox.append(Notice("Presets", question, "yellow", replaces=True))
            return
        said = self._run(presets, workbench)
        workbench.preset_use = replace(use, done=True)
        workbench.outbox.append(Notice("Presets", said, replaces=True))

    def _question(self, presets: Presets) -> str:
        if self.action == "save" and self.name in presets.names():
            return f"There is a preset {self.name} already. Press Save once more to replace it."
        if self.action == "delete":
            return f"Press Delete once more to delete the preset {self.name}."
        return ""

    def _run(self, presets: Presets, workbench: Workbench) -> str:
        """Run the action, and return what was done in a sentence."""
        if not self.name or (self.action == "rename" and not self.new_name):
            raise InputError("Type a name first.")
        match self.action:
            case "load":
                workbench.tuning.set(presets.load(self.name))
                return f"The parameters are those of {self.name} now."
            case "save":
                presets.save(self.name, workbench.tuning.parameters)
                return f"{self.name} holds these parameters now."
            case "rename":
                presets.rename(self.name, self.new_name)
                return f"{self.name} is called {self.new_name} now."
            case "delete":
                presets.delete(self.name)
                return f"{self.name} is deleted."


class PresetsPanel(Panel):
    """Controls to save, load and delete presets and files."""

    def __init__(self, context: PanelContext) -> None:
        gui, post = context.client.gui, context.post
        self._presets = Presets(preset_folder())
        self._listed_at = -_AGE
        self._use: PresetUse | None = None
        self._list: viser.GuiDropdownHandle[str] = gui.add_dropdown(
            "Preset", [_NONE], hint=f"Parameters that were saved in {preset_folder()}."
        )
        uses = gui.add_button_group("", tuple(_USES))
        self._name = gui.add_text(
            "Name",
            "",
            hint="Under which Save keeps the parameters, or the chosen preset's new one.",
        )
        names = gui.add_button_group("", tuple(_NAMINGS))
        save = gui.add_button(
            "Save parameters as a file",
            icon=Icon.DOWNLOAD,
            color="gray",
            hint="A file for --parameters of the command line.",
        )
        self._upload = gui.add_upload_button(
            "Open a parameter file",
            icon=Icon.UPLOAD,
            color="gray",
            mime_type="application/json",
            hint="As Save parameters as a file makes it.",
        )

        # Coroutines run at once, before the control's value can change again.
        @uses.on_click
        async def _(_: viser.GuiEvent) -> None:
            if (name := self._list.value) != _NONE:
                post_chosen(post, uses, _USES, lambda action: UsePreset(action, name))

        @names.on_click
        async def _(_: viser.GuiEvent) -> None:
            typed, chosen = composed(self._name.value), self._list.value
            if names.value == "Save":
                post(UsePreset("save", typed))
            elif chosen != _NONE:
                post(UsePreset("rename", chosen, typed))

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
            elif use.action == "rename":
                chosen = composed(self._name.value)
        if used or time.monotonic() > self._listed_at + _AGE:
            self._show(chosen)

    def _show(self, chosen: str) -> None:
        names = tuple(self._presets.names()) or (_NONE,)
        self._listed_at = time.monotonic()
        if names != self._list.options:
            self._list.options = names
        show_value(self._list, chosen if chosen in names else names[0])
