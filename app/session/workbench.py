"""Mutable state of one session, used by the session's thread alone."""

import time
from collections.abc import Mapping, Sequence
from dataclasses import asdict, replace
from typing import Any

import viser

from app.analysis.estimates import Estimates
from app.analysis.first_frame import first_frame_with_flow
from app.analysis.library import Library, Opened
from app.analysis.live_timeline import LiveTimeline
from app.analysis.notes import notes
from app.analysis.pairs import Pair
from app.analysis.selection import cluster_of
from app.errors import InputError
from app.scene.framing import Framing
from app.scene.pointer_view import PointerView
from app.scene.rendering import SceneRenderer
from app.scene.scene import Scene
from app.scene.settings import ViewSettings
from app.session.choice import Choice
from app.session.clock import PlaybackClock
from app.session.drawing import Drawing
from app.session.followed_sides import FollowedSides
from app.session.inspection import Inspection
from app.session.links import SavedSession
from app.session.look_ahead import LookAhead
from app.session.marks import Marks
from app.session.open_requests import OpenRequests
from app.session.outbox import Message, Notice
from app.session.presets import PresetUse
from app.session.snapshot import Snapshot, Status
from app.session.tasks import Tasks
from app.session.tuning import Tuning
from estimator import ClusterResult


class Workbench:
    """State of a session and its scene; commands change it, snapshots are taken of it.

    Args:
        client: the browser client, on which the scene is drawn.
        library: opens recordings.
        estimates: computes and caches flows.
        choice: of the recordings that may be opened.
        tuning: parameters, initially.
        settings: of the drawing, initially.
        surveys, timeline: of the open recording.
        tasks: in the background.

    Attributes:
        open_requests: recordings that are to be opened.
        opened: the open recording, None without one.
        frame: k.
        clock: of the playback.
        tuning: the parameters.
        settings: of the drawing; changed by `change_view`.
        scene: in the client's browser.
        framing: moves the scene's camera to views.
        renderer: renders pictures of the scene.
        inspection: of zones and sensors.
        preset_use: the last use of a preset, None before the first.
        marks: of the open recording, None without one.
        edited_mark: number of times that a mark was to be edited.
        plotted_pair: quantities (x, y) that are plotted against each other, None for none.
        outbox: messages for the browser, emptied by the next status or snapshot.
    """

    def __init__(
        self,
        client: viser.ClientHandle,
        library: Library,
        estimates: Estimates,
        choice: Choice,
        tuning: Tuning,
        settings: ViewSettings,
        surveys: FollowedSides,
        timeline: LiveTimeline,
        tasks: Tasks,
    ) -> None:
        self._client = client
        self.library, self.estimates, self.choice = library, estimates, choice
        self.tuning, self.settings = tuning, settings
        self.surveys, self.timeline, self.tasks = surveys, timeline, tasks
        self.open_requests = OpenRequests(library, choice.listing.entries)
        self.opened: Opened | None = None
        self.clock, self.frame = PlaybackClock([0.0]), 0
        self.scene = Scene(client, settings)
        self.framing, self.renderer = Framing(client, self.scene), SceneRenderer(client, self.scene)
        self.inspection = Inspection(PointerView(client), self.scene)
        self._drawing = Drawing(client, estimates, self.scene, self.framing)
        self._ahead = LookAhead(estimates)
        self.preset_use: PresetUse | None = None
        self.marks: Marks | None = None
        self.edited_mark = 0
        self.plotted_pair: tuple[str, str] | None = None
        self.outbox: list[Message] = []

    @property
    def pair(self) -> Pair | None:
        """The pair that is drawn, None without one."""
        return self._drawing.pair

    def open_next(self) -> None:
        """Open the next requested recording in place of the open one, and tell of failures."""
        opened = self.open_requests.try_next()
        if opened is not None:
            self._begin(opened)
        if failed := self.open_requests.take_failure():
            kept = self.opened and self.opened.entry.label
            self.outbox.append(failed.notice() if opened else replace(failed, kept=kept))

    def draw(self) -> None:
        """Draw the frame that is due, if anything has changed."""
        if self.opened is None:
            return
        parameters, comparison = self.tuning.parameters, self.tuning.comparison
        if self.clock.playing:
            now = time.monotonic()
            due = self.clock.advance(now)
            self.frame = self._ahead.frame_to_draw(self.opened, due, self.frame, parameters)
            self._ahead.follow(self.opened, self.clock, now, self.frame, parameters)
        other = comparison.other if comparison else None
        try:
            self._drawing.draw(self.opened, self.frame, parameters, comparison)
        finally:
            self.surveys.follow(self.opened, parameters, other, self.frame)
        self.inspection.follow(self.opened, self.pair, parameters.max_range, self.settings)

    def seek(self, frame: int) -> None:
        """Go to a frame, clipped to the recording."""
        if self.opened is None:
            return
        self.frame = min(max(frame, 0), len(self.opened.recording) - 1)
        if self.clock.playing:
            self.clock.play(self.frame, time.monotonic())

    def toggle_play(self) -> None:
        """Play if paused, else pause."""
        if self.opened is None:
            return
        if self.clock.playing:
            self.clock.pause()
        else:
            playback = self.clock.playback
            ends = (playback.last, len(self.opened.recording) - 1)
            start = playback.first if self.frame in ends else self.frame
            self.clock.play(start, time.monotonic())

    def change_view(self, values: Mapping[str, Any]) -> None:
        """Change some settings of the drawing, {name: value}.

        A page that was made dark or light by hand does not follow the system any more.
        """
        if "dark" in values:
            values = {"follows_system": False, **values}
        self.settings = replace(self.settings, **values)
        self.scene.change(self.settings)

    @property
    def picked(self) -> ClusterResult | None:
        """The picked cluster of the pair, None for none."""
        return None if self.pair is None else cluster_of(self.pair, self._drawing.picked)

    def pick(self, cluster: int | None) -> None:
        """Pick the cluster with this index, or none."""
        self._drawing.pick(cluster)

    def pick_at(self, origin: Sequence[float], direction: Sequence[float]) -> None:
        """Pick cluster, zone and sensor hit by a ray (3,), (3,) in the drawing, or none."""
        if self.pair is not None:
            self.pick(self.inspection.pin_along(origin, direction))

    def saved(self) -> SavedSession | None:
        """State that a reload of the page restores, None without an open recording."""
        if self.opened is None:
            return None
        return SavedSession(
            label=self.opened.entry.label,
            frame=self.frame,
            parameters=self.tuning.parameters,
            camera=self.scene.camera(),
            settings=self.settings,
            comparison=self.tuning.comparison,
            playback=self.clock.playback,
            playing=self.clock.playing,
            picked=self._drawing.picked,
            plotted_pair=self.plotted_pair,
            selected=self.inspection.inspected.selected,
            pinned=self.inspection.pinned,
            up=self.framing.up,
        )

    def restore(self, saved: SavedSession) -> None:
        """Restore a saved session, after opening its recording and before drawing.

        Its parameters and settings were already given to the session at its start.
        """
        self.seek(saved.frame)
        self.tuning.comparison = saved.comparison
        self.plotted_pair = saved.plotted_pair
        self._drawing.await_cluster(saved.picked)
        self.inspection.start_from(saved.selected, saved.pinned)
        if saved.camera:
            self.framing.start_from(saved.camera, saved.up)
        if saved.playback:
            self.clock.change(asdict(saved.playback), self.frame, time.monotonic())
        if saved.playing:
            self.toggle_play()

    def status(self) -> Status:
        """State before opening or drawing; empties the outbox."""
        return Status(opened=self.opened, **self._status())

    def snapshot(self, *, seeking: bool) -> Snapshot | None:
        """State after `draw`; empties the outbox.

        Args:
            seeking: whether the user is moving the frame slider.

        Returns:
            The snapshot, None without an open recording.
        """
        if self.opened is None:
            return None
        return Snapshot(
            opened=self.opened,
            frame=self.frame,
            comparison=self.tuning.comparison,
            settings=self.settings,
            legend=self.scene.legend,
            scale_bar=self.framing.scale_bar,
            pair=self.pair,
            other=self._drawing.other,
            picked=self._drawing.picked,
            playing=self.clock.playing,
            playback=self.clock.playback,
            marks=self.marks.known if self.marks else (),
            edited_mark=self.edited_mark,
            plotted_pair=self.plotted_pair,
            timeline=self.timeline.of(self.opened, self.tuning.parameters),
            seeking=seeking,
            survey=self.surveys.edited.survey,
            survey_revision=self.surveys.edited.revision,
            other_survey=self.surveys.other.survey,
            other_survey_revision=self.surveys.other.revision,
            inspected=self.inspection.inspected,
            out_of_picture=self.pair is not None and self.framing.misses(self.pair),
            **self._status(),
        )

    def close(self) -> None:
        """End all tasks, and release the recording."""
        self.tasks.end()
        self.choice.leave()
        self._ahead.close()
        if self.opened is not None:
            self._release(self.opened)
            self.opened = None

    def _begin(self, opened: Opened) -> None:
        before, self.opened = self.opened, opened
        if before is not None:
            self._release(before)
        recording = opened.recording
        self.clock = PlaybackClock(recording.stamps, like=self.clock.playback)
        self.marks = Marks(opened.entry.path, recording.stamps)
        try:
            self.marks.load()
        except InputError as error:
            self.outbox.append(Notice("Marks", str(error), "yellow", seconds=15.0))
        self.frame = first_frame_with_flow(opened, self.tuning.parameters, self.estimates)
        self._drawing.drop()
        with self._client.atomic():
            self.scene.open(recording)
        if notes(recording):
            said = "Notes on this recording stand beside its name."
            self.outbox.append(Notice(opened.entry.label, said, "yellow", replaces=True))

    def _release(self, opened: Opened) -> None:
        self.surveys.stop()
        self._ahead.stop()
        self.timeline.stop()
        self.library.release(opened.entry)

    def _status(self) -> dict[str, Any]:
        outbox, self.outbox = tuple(self.outbox), []
        return {
            "opening": self.open_requests.label,
            "listing": self.choice.listing,
            "parameters": self.tuning.parameters,
            "parameters_revision": self.tuning.revision,
            "corrections": dict(self.tuning.corrections),
            "corrected": self.tuning.corrected,
            "preset_use": self.preset_use,
            "tasks": self.tasks.states,
            "outbox": outbox,
        }
