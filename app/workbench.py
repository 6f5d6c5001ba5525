"""What a session holds, and what becomes of it at each wish; used by one thread alone."""

import time
from collections.abc import Sequence
from dataclasses import replace
from typing import Any

import viser

from app.estimates import Estimates
from app.evaluation import counting_pairs
from app.library import Entry, Library, Opened
from app.mailbox import Mailbox, Wish
from app.page import Page
from app.parameter_files import to_text
from app.playback_clock import PlaybackClock
from app.reloads import Left
from app.scene.scene import Scene, ViewSettings
from app.wishes import (
    ChangeParameters,
    ChangeView,
    OpenRecording,
    ResetParameters,
    SaveParameters,
    Seek,
    Step,
    TakeScreenshot,
    TogglePlay,
)
from estimator import ParameterError, Parameters
from recordings import Recording


class Workbench:
    """Recording, frame, parameters and view of one client, and its page and scene.

    Args:
        client: the browser client.
        library: opens recordings.
        estimates: computes and remembers.
        entries: the recordings that may be opened, at least one.
        parameters: to begin with.
        defaults: to go back to.
        mailbox: takes the wishes of the page's controls, from any thread.
    """

    def __init__(
        self,
        client: viser.ClientHandle,
        library: Library,
        estimates: Estimates,
        entries: Sequence[Entry],
        parameters: Parameters,
        defaults: Parameters,
        mailbox: Mailbox,
    ) -> None:
        self._client = client
        self._library = library
        self._mailbox = mailbox
        self._estimates = estimates
        self._entries = {entry.label: entry for entry in entries}
        self._parameters = parameters
        self._defaults = defaults
        self._settings = ViewSettings()
        self._opened: Opened | None = None
        self._clock = PlaybackClock([0.0])
        self._frame = 0
        self._drawn: tuple[Opened, int, Parameters] | None = None
        self._scene = Scene(client, self._settings)
        self._page = Page(client, entries, parameters, self._settings, mailbox.post)

    def wait(self) -> float | None:
        """Seconds until a frame is due, None where none will be."""
        return self._clock.wait(self._frame, time.monotonic())

    def fulfil(self, wish: Wish) -> None:
        """Do what is wished, without drawing the pair yet."""
        match wish:
            case OpenRecording(label):
                self._open(label)
            case ChangeParameters(values):
                self._change_parameters(dict(values))
            case ResetParameters():
                self._parameters = self._defaults
                self._page.parameters.show(self._parameters)
            case ChangeView(values):
                self._settings = replace(self._settings, **dict(values))
                self._scene.change(self._settings)
            case Seek(frame):
                self._seek(frame)
            case Step(frames):
                self._seek(self._frame + frames)
            case TogglePlay(times):
                self._toggle(times)
            case SaveParameters():
                content = to_text(self._parameters).encode()
                self._client.send_file_download("parameters.json", content, save_immediately=True)
            case TakeScreenshot() if self._opened:
                self._page.screenshot.take(self._opened.recording.name, self._frame)

    def draw(self) -> None:
        """Bring scene and page up to date, with whatever frame is due by now."""
        if self._opened is None or self._mailbox.waits(OpenRecording):
            return  # nothing is computed for a recording that is about to be left
        self._follow_clock()
        wanted = (self._opened, self._frame, self._parameters)
        try:
            if wanted != self._drawn:
                self._draw_pair(*wanted)
        finally:
            # Where a frame cannot be drawn, its number is shown all the more.
            stamps = self._opened.recording.stamps
            seconds = float(stamps[self._frame] - stamps[0])
            self._page.playback.show(
                self._frame,
                len(stamps),
                seconds,
                playing=self._clock.playing,
                seeking=self._mailbox.waits(Seek),
            )

    def close(self) -> Left | None:
        """Give back the recording; what was shown is returned, for when the client comes again."""
        if self._opened is None:
            return None
        left = Left(self._opened.entry.label, self._frame, self._parameters)
        self._library.release(self._opened.entry)
        self._opened = None
        return left

    def _draw_pair(self, opened: Opened, frame: int, parameters: Parameters) -> None:
        problem: Exception | None = None
        try:
            pair = self._estimates.estimated(opened, frame, parameters)
        except Exception as error:
            # The clouds are shown even where the estimator fails on them.
            problem, pair = error, self._estimates.pair(opened, frame, parameters)
        with self._client.atomic():
            self._scene.show(pair)
            if self._drawn is None or self._drawn[0] is not opened:
                self._scene.place_camera(pair)
        self._page.status.show(pair, parameters, simulated=opened.recording.simulated)
        self._drawn = (opened, frame, parameters)
        if problem is not None:
            raise problem

    def _open(self, label: str) -> None:
        # Only what the server listed is ever opened, whatever a browser sends.
        entry = self._entries.get(label)
        if entry is None or (self._opened is not None and self._opened.entry == entry):
            return
        try:
            opened = self._library.open(entry)
        except Exception:
            self._page.recordings.show(self._opened)
            raise
        before, self._opened = self._opened, opened
        if before is not None:
            self._library.release(before.entry)
        recording = opened.recording
        self._clock = PlaybackClock(recording.stamps)
        self._frame = opening_frame(recording, self._parameters.n)
        with self._client.atomic():
            self._scene.open(recording)
        self._page.open(opened)

    def _change_parameters(self, values: dict[str, Any]) -> None:
        try:
            self._parameters = replace(self._parameters, **values)
        except ParameterError as error:
            self._page.parameters.refuse(values, str(error))
        else:
            self._page.parameters.accept(self._parameters)

    def _seek(self, frame: int) -> None:
        if self._opened is None:
            return
        self._frame = min(max(frame, 0), len(self._opened.recording) - 1)
        if self._clock.playing:
            self._clock.play(self._frame, time.monotonic())

    def _toggle(self, times: int) -> None:
        if self._opened is None or times % 2 == 0:
            return
        if self._clock.playing:
            self._clock.pause()
        else:
            at_end = self._frame == len(self._opened.recording) - 1
            self._clock.play(0 if at_end else self._frame, time.monotonic())

    def _follow_clock(self) -> None:
        if self._clock.playing:
            now = time.monotonic()
            self._frame = self._clock.frame(now)
            if self._clock.at_end(now):
                self._clock.pause()


def opening_frame(recording: Recording, n: int) -> int:
    """The frame in the middle of the motion, or of the recording where no motion is known."""
    moving = list(counting_pairs(recording, n))
    if moving:
        return moving[len(moving) // 2][1]
    return min(max(n, len(recording) // 2), len(recording) - 1)
