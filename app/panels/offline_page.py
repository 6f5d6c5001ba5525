"""The whole recording as one HTML file, made while the session goes on."""

import logging
import threading
import time
from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal

import viser

from app.analysis.estimates import Estimates
from app.analysis.library import Entry, Library, Opened
from app.errors import InputError, UserError
from app.exports.file_names import safe
from app.exports.offline_page import ExportEndedError, offline_page
from app.panels.panel import Desk, Panel
from app.scene.views import THREE_D
from app.session.commands import LatestWins
from app.session.links import Place

if TYPE_CHECKING:
    from app.session.workbench import Workbench

_LOG = logging.getLogger(__name__)
_TITLE = "Offline page"
_QUIET = 0.02  # seconds for which nobody has waited for an estimate, before the next frame
_PATIENCE = 0.5  # seconds after which it goes on all the same


@dataclass(frozen=True)
class SaveOfflinePage(LatestWins):
    """Save the recording as a page."""

    panel: "OfflinePagePanel"

    def fulfil(self, workbench: "Workbench") -> None:
        """Begin to make it, where there is a recording; InputError where one is being made."""
        place = workbench.place()
        if workbench.opened is not None and place is not None:
            self.panel.begin(workbench.library, workbench.opened.entry, place, workbench.estimates)


class OfflinePagePanel(Panel):
    """A button that makes an offline page in the background, and sends it when it is ready."""

    def __init__(self, desk: Desk) -> None:
        self._client = desk.client
        self._thread: threading.Thread | None = None
        self._ended = threading.Event()
        button = desk.client.gui.add_button(
            "Save offline page",
            icon=viser.Icon.MOVIE,
            color="gray",
            hint="All frames as one HTML file, which plays in any browser without network",
        )

        command = desk.client.gui.add_command("Save offline page", icon=viser.Icon.MOVIE)

        @button.on_click
        async def _(_: viser.GuiEvent) -> None:
            desk.post(SaveOfflinePage(self))

        @command.on_trigger
        async def _(_: viser.CommandEvent) -> None:
            desk.post(SaveOfflinePage(self))

    def begin(self, library: Library, entry: Entry, place: Place, estimates: Estimates) -> None:
        """Make the page of a recording in a thread of its own, as it is seen from a place.

        The recording stays open for it, whatever the session opens meanwhile.

        Raises:
            InputError: one is being made already.
            RecordingError: the recording cannot be opened.
        """
        if self._thread is not None and self._thread.is_alive():
            raise InputError("An offline page is being made already; wait until it is there.")
        self._ended.clear()
        self._thread = threading.Thread(
            target=self._make,
            args=(library, library.open(entry), place, estimates),
            name="offline page",
        )  # not a daemon: it must not be cut off inside of Open3D when the program ends
        self._thread.start()

    def leave(self) -> None:
        """End what is being made, before its next frame."""
        self._ended.set()

    def _make(self, library: Library, opened: Opened, place: Place, estimates: Estimates) -> None:
        try:
            self._draw(opened, place, estimates)
        finally:
            library.release(opened.entry)

    def _draw(self, opened: Opened, place: Place, estimates: Estimates) -> None:
        frames = range(len(opened.recording))
        said = self._client.add_notification(
            _TITLE, "Drawing frame by frame.", loading=True, with_close_button=False
        )
        told = time.monotonic()

        def progress(index: int) -> None:
            nonlocal told
            estimates.foreground.wait_until_quiet(_QUIET, _PATIENCE)
            if self._ended.is_set():
                raise ExportEndedError
            if time.monotonic() > told + 0.3:
                told = time.monotonic()
                said.body = f"Frame {index} of {len(frames) - 1}."

        try:
            page = offline_page(
                opened,
                frames,
                place.parameters,
                place.settings,
                place.camera or THREE_D,
                estimates,
                progress,
                place.comparison,
            )
        except ExportEndedError:
            return
        except UserError as error:
            self._say(str(error), "red")
        except Exception as error:
            _LOG.debug("An unexpected error.", exc_info=True)
            self._say(f"It could not be made ({type(error).__name__}: {error}).", "red")
        else:
            name, content = f"{safe(opened.recording.name)}.html", page.encode()
            self._client.send_file_download(name, content, save_immediately=True)
            self._say(f"{name}, {len(content) / 1e6:.1f} MB, is in your downloads.", "green")
        finally:
            said.remove()

    def _say(self, sentence: str, colour: Literal["red", "green"]) -> None:
        self._client.add_notification(_TITLE, sentence, color=colour, auto_close_seconds=10)
