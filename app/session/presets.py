"""Parameters under names, as files in the user's own folder."""

import re
import unicodedata
from dataclasses import dataclass
from pathlib import Path
from typing import Literal

from platformdirs import user_config_path

from app.analysis.parameter_files import load, to_text
from app.errors import InputError
from app.output.checks import PARAMETERS, check_output
from app.output.writing import write
from estimator import Parameters

PresetAction = Literal["load", "save", "rename", "delete"]

_PATIENCE = 10.0  # seconds within which a question is answered

# Letters, digits and what stands between them: no path can be made of it, and no hidden file.
_NAME = re.compile(r"\w(?:[\w .-]{0,48}[\w-])?")


def preset_folder() -> Path:
    """Folder of the user's presets: tofscope/presets in $XDG_CONFIG_HOME or ~/.config on Linux."""
    return user_config_path("tofscope", appauthor=False) / "presets"


@dataclass(frozen=True)
class PresetUse:
    """Use of a preset; another one each time.

    Attributes:
        action: tried with it.
        name: of the preset.
        done: whether it was done.
        asked: seconds of a monotonic clock at which a question was asked instead, None without one.
    """

    action: PresetAction
    name: str
    done: bool
    asked: float | None = None

    def confirms(self, before: "PresetUse | None", now: float) -> bool:
        """Whether this use repeats an earlier one that was answered with a question."""
        return (
            before is not None
            and before.asked is not None
            and (before.action, before.name) == (self.action, self.name)
            and now < before.asked + _PATIENCE
        )


class Presets:
    """Named parameters, a JSON file each that --parameters takes too.

    Args:
        folder: made where it is needed.
    """

    def __init__(self, folder: Path) -> None:
        self._folder = folder

    def names(self) -> list[str]:
        """All names, in their order."""
        found = (path.stem for path in self._folder.glob("*.json"))
        return sorted((name for name in found if _NAME.fullmatch(name)), key=str.casefold)

    def load(self, name: str) -> Parameters:
        """The parameters under a name.

        Raises:
            InputError: there is no such name, or its file is broken.
        """
        return load(self._path(name))

    def save(self, name: str, parameters: Parameters) -> None:
        """Keep parameters under a name, in place of those that may be there.

        Raises:
            InputError: the name or the folder cannot be used, or something else is there.
        """
        path = self._path(name)
        try:
            self._folder.mkdir(parents=True, exist_ok=True)
        except OSError as error:
            raise InputError(f"The preset cannot be saved at {path} ({error.strerror}).") from error
        check_output(path, PARAMETERS)
        write(path, to_text(parameters).encode())

    def rename(self, name: str, new_name: str) -> None:
        """Give a preset another name.

        Raises:
            InputError: there is no such preset, or the new name is in use or cannot be used.
        """
        if new_name in self.names():
            raise InputError(f"There is a preset {new_name} already; choose another name.")
        self.save(new_name, self.load(name))
        self.delete(name)

    def delete(self, name: str) -> None:
        """Forget a name.

        Raises:
            InputError: its file cannot be deleted.
        """
        path = self._path(name)
        try:
            path.unlink(missing_ok=True)
        except OSError as error:
            raise InputError(f"{path} cannot be deleted ({error.strerror}).") from error

    def _path(self, name: str) -> Path:
        if not _NAME.fullmatch(name):
            raise InputError(
                "A preset's name is made of letters, digits, spaces, dots, dashes and underscores, "
                f"50 of them at most, and begins with a letter or digit; got {name[:60]!r}."
            )
        return self._folder / f"{name}.json"


def composed(name: str) -> str:
    """A typed name without spaces around it, with letters as one character each (NFC)."""
    return unicodedata.normalize("NFC", name.strip())
