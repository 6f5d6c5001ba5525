"""What a session holds, and what becomes of it at each wish; used by one thread alone."""

import time
from collections.abc import Mapping, Sequence
from dataclasses import asdict, replace
from typing import Any

import numpy as np
import viser
from numpy.typing import NDArray

from app.analysis.comparison import A, Comparison, compared
from app.analysis.estimates import Estimates, Pair
from app.analysis.first_frame import telling_frame
from app.analysis.library import Entry, Library, Opened
from app.analysis.live_timeline import Outlook
from app.analysis.selection import Selection, cluster_at, cluster_of
from app.analysis.surveys import Surveys
from app.analysis.timeline import Timeline
from app.panels.page import Page
from app.panels.panel import Desk, Shown
from app.scene.framing import Framing
from app.scene.legend import Legend
from app.scene.photograph import photograph
from app.scene.scene import Scene
from app.scene.settings import ViewSettings
from app.session.clock import Playback, PlaybackClock
from app.session.commands import Move, OpenRecording
from app.session.history import ParameterHistories, ParameterHistory
from app.session.links import Place
from app.session.queue import Mailbox
from estimator import Parameters


class Workbench:
    """Recording, frame, parameters and view of one client, and its page and scene.

    Args:
        client: the browser client.
        library: opens recordings.
        estimates: computes and remembers.
        surveys: computes whole recordings in the background.
        entries: the recordings that may be opened, at least one.
        parameters: to begin with.
        defaults: to go back to.
        settings: of the drawing, to begin with.
        mailbox: takes the wishes of the page's controls, from any thread.
    """

    def __init__(
        self,
        client: viser.ClientHandle,
        library: Library,
        estimates: Estimates,
        surveys: Surveys,
        entries: Sequence[Entry],
        parameters: Parameters,
        defaults: Parameters,
        settings: ViewSettings,
        mailbox: Mailbox,
    ) -> None:
        self.client = client
        self.library = library
        self._mailbox = mailbox
        self.estimates = estimates
        self._entries = {entry.label: entry for entry in entries}
        self.parameters = parameters
        self.defaults = defaults
        self.settings = settings
        self.opened: Opened | None = None
        self._clock = PlaybackClock([0.0])
        self.frame = 0
        self.comparison: Comparison | None = None
        self._drawn: tuple[Opened, int, Parameters, Comparison | None] | None = None
        self._histories = ParameterHistories()
        self._scene = Scene(client, self.settings)
        self._framing = Framing(client, self._scene)
        self._pair: Pair | None = None
        self._other: Pair | None = None
        self._outlook = Outlook(estimates, surveys)
        self._selection = Selection()
        self._picked: int | None = None
        self.page = Page(Desk(client, entries, parameters, self.settings, mailbox.post, surveys))

    @property
    def playback(self) -> Playback:
        """How the recording is played."""
        return self._clock.playback

    @property
    def legend(self) -> Legend:
        """What the colours of the scene mean."""
        return self._scene.legend

    def wait(self) -> float | None:
        """Seconds until a frame is due, None where none will be."""
        return self._clock.wait(self.frame, time.monotonic())

    def draw(self) -> None:
        """Bring scene and page up to date, with whatever frame is due by now."""
        if self.opened is None or self._mailbox.waits(OpenRecording):
            return  # nothing is computed for a recording that is about to be left
        if self._clock.playing:
            self.frame = self._clock.advance(time.monotonic())
        wanted = (self.opened, self.frame, self.parameters, self.comparison)
        try:
            if wanted != self._drawn:
                self._draw_pairs(*wanted)
        finally:
            # Where a frame cannot be drawn, its number is shown all the more.
            self.page.show(self._shown(self.opened))

    def open(self, label: str) -> None:
        """Open the recording with this label; one that is not in the list is ignored."""
        # Only what the server listed is ever opened, whatever a browser sends.
        entry = self._entries.get(label)
        if entry is None or (self.opened is not None and self.opened.entry == entry):
            return
        with self.page.recordings.opening(label, self.opened):
            opened = self.library.open(entry)
        before, self.opened = self.opened, opened
        if before is not None:
            self.page.close()
            self.library.release(before.entry)
        recording = opened.recording
        self._clock = PlaybackClock(recording.stamps, like=self._clock.playback)
        self.frame = telling_frame(opened, self.parameters, self.estimates)
        self._selection.drop()
        with self.client.atomic():
            self._scene.open(recording)
        self.page.open(opened)

    def seek(self, frame: int) -> None:
        """Go to a frame; a number outside the recording means its first or last one."""
        if self.opened is None:
            return
        self.frame = min(max(frame, 0), len(self.opened.recording) - 1)
        if self._clock.playing:
            self._clock.play(self.frame, time.monotonic())

    def toggle_play(self) -> None:
        """Play where it stands still, and the other way round."""
        if self.opened is None:
            return
        if self._clock.playing:
            self._clock.pause()
        else:
            ends = (self.playback.last, len(self.opened.recording) - 1)
            start = self.playback.first if self.frame in ends else self.frame
            self._clock.play(start, time.monotonic())

    def change_playback(self, values: dict[str, Any]) -> None:
        """Play otherwise, {field of `Playback`: value}."""
        self._clock.change(values, self.frame, time.monotonic())

    def timeline(self) -> Timeline | None:
        """The recording at a glance, None where none is open."""
        return self._outlook.timeline(self.opened, self.parameters) if self.opened else None

    def change_parameters(self, values: Mapping[str, Any]) -> None:
        """Change some parameters, {name: value}; ParameterError where one is out of range."""
        before, self.parameters = self.parameters, replace(self.parameters, **values)
        self._history.note(before, self.parameters, time.monotonic())

    def set_parameters(self, parameters: Parameters) -> None:
        """Take other parameters, and show them in the page's controls."""
        before, self.parameters = self.parameters, parameters
        self._history.note(before, parameters, None)
        self.page.parameters.replace(parameters)

    def undo_parameters(self, changes: int) -> None:
        """Undo this many changes of the parameters, or redo where it is negative."""
        go = self._history.undo if changes > 0 else self._history.redo
        for _ in range(abs(changes)):
            self.parameters = go(self.parameters) or self.parameters
        self.page.parameters.replace(self.parameters)

    def compare(self, comparison: Comparison | None, edited: Parameters) -> None:
        """Compare otherwise, or not at all, and edit these parameters."""
        self._histories.compare(self.comparison, self.parameters, comparison, edited)
        self.comparison, self.parameters = comparison, edited
        self.page.parameters.replace(edited)

    def change_view(self, values: Mapping[str, Any]) -> None:
        """Change some settings of the drawing, {name: value}."""
        self.settings = replace(self.settings, **values)
        self._scene.change(self.settings)

    def pick(self, cluster: int | None) -> None:
        """Pick the cluster with this index, or none."""
        if self._pair is not None:
            self._selection.pick(self._pair, cluster)
            self._mark()

    def pick_at(self, origin: Sequence[float], direction: Sequence[float]) -> bool:
        """Pick the cluster under a ray (3,), (3,) of the drawing; none, False, if it misses all."""
        if self._pair is not None:
            ray = (self._scene.in_fixed_frame(np.array(v)) for v in (origin, direction))
            self.pick(cluster_at(self._pair, *ray))
        return self._picked is not None

    def look(self, view: str) -> None:
        """Put the camera to the view of this name."""
        if self._pair is not None:
            self._framing.look(self._pair, view)

    def photograph(self, view: str | None, width: int, height: int) -> NDArray[np.uint8]:
        """Pixels (height, width, 4) of a view by its name, or of what the page shows for None.

        Raises:
            RuntimeError: the browser has gone, or there is nothing to see.
            TimeoutError: it gives no picture, such as one whose tab is in the background.
        """
        if self._pair is None:
            raise RuntimeError("There is nothing to see.")
        return photograph(self.client, self._scene, self._pair, view, width, height)

    def focus(self) -> None:
        """Draw in sizes that suit where the camera is now, and in the picture's new shape."""
        self._scene.focus()
        if self._pair is not None:
            self._framing.follow(self._pair)

    def place(self) -> Place | None:
        """What is shown, None where nothing is."""
        if self.opened is None:
            return None
        return Place(
            label=self.opened.entry.label,
            frame=self.frame,
            parameters=self.parameters,
            camera=self._scene.camera(),
            settings=self.settings,
            comparison=self.comparison,
            playback=self.playback,
            playing=self._clock.playing,
        )

    def arrive(self, place: Place) -> None:
        """Show a place in the recording that is open and not drawn yet."""
        self.seek(place.frame)
        self.comparison = place.comparison
        if place.camera:
            self._framing.stand(place.camera)
        if place.playback:
            self.change_playback(asdict(place.playback))
        if place.playing:
            self.toggle_play()

    def close(self) -> None:
        """Give back the recording."""
        self.page.leave()
        if self.opened is not None:
            self.page.close()
            self.library.release(self.opened.entry)
            self.opened = None

    @property
    def _history(self) -> ParameterHistory:
        return self._histories.of(self.comparison)

    def _shown(self, opened: Opened) -> Shown:
        return Shown(
            opened=opened,
            frame=self.frame,
            parameters=self.parameters,
            settings=self.settings,
            legend=self.legend,
            pair=self._pair,
            comparison=self.comparison,
            other=self._other,
            picked=self._picked,
            playing=self._clock.playing,
            playback=self.playback,
            timeline=self._outlook.timeline(opened, self.parameters),
            seeking=self._mailbox.waits(Move),
        )

    def _draw_pairs(
        self, opened: Opened, frame: int, parameters: Parameters, comparison: Comparison | None
    ) -> None:
        self._pair = self._other = None
        found = compared(self.estimates, opened, frame, parameters, comparison)
        self._pair, self._other = found.pair, found.other
        with self.client.atomic():
            self._scene.show(found.pair, found.second, comparison.edited if comparison else A)
            self._mark()
            if self._drawn is None or self._drawn[0] is not opened:
                self._framing.begin(found.pair)
            else:
                self._framing.seen(found.pair)
        self._drawn = (opened, frame, parameters, comparison)
        if found.problem is not None:
            raise found.problem

    def _mark(self) -> None:
        if self._pair is not None:
            self._picked = self._selection.follow(self._pair)
            self._scene.mark(self._pair, cluster_of(self._pair, self._picked))
