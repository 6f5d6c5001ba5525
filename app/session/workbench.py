"""Mutable state of one session, used by the session's thread alone."""

import time
from collections.abc import Mapping, Sequence
from dataclasses import asdict, replace
from typing import Any

import numpy as np
import viser

from app.analysis.comparison import A, Comparison, estimate_frame
from app.analysis.estimates import Estimates
from app.analysis.first_frame import first_frame_with_flow
from app.analysis.library import Entry, Library, Opened
from app.analysis.live_timeline import LiveTimeline
from app.analysis.pairs import Pair
from app.analysis.selection import Selection, cluster_at, cluster_of
from app.scene.framing import Framing
from app.scene.rendering import SceneRenderer
from app.scene.scene import Scene
from app.scene.settings import ViewSettings
from app.session.clock import PlaybackClock
from app.session.followed_survey import FollowedSurvey
from app.session.links import SavedSession
from app.session.open_requests import OpenRequests
from app.session.outbox import Message, Notice
from app.session.presets import PresetUse
from app.session.snapshot import Snapshot, Status, TimeSeek
from app.session.tasks import Tasks
from app.session.tuning import Tuning
from estimator import Parameters


class Workbench:
    """State of a session and its scene; commands change it, snapshots are taken of it.

    Args:
        client: the browser client, on which the scene is drawn.
        library: opens recordings.
        estimates: computes and caches flows.
        entries: the listed recordings.
        tuning: parameters, initially.
        settings: of the drawing, initially.
        survey: of the open recording.
        timeline: of the open recording.
        tasks: in the background.

    Attributes:
        opening: recordings requested to be opened.
        opened: the open recording, None without one.
        frame: k.
        clock: of the playback.
        time_seek: the last seek to a typed time, None before the first.
        tuning: the parameters.
        settings: of the drawing; changed by `change_view`.
        scene: in the client's browser.
        framing: moves the scene's camera to views.
        renderer: renders pictures of the scene.
        pair: that is drawn, None without one.
        preset_use: the last use of a preset, None before the first.
        outbox: messages for the browser, emptied by the next status or snapshot.
    """

    def __init__(
        self,
        client: viser.ClientHandle,
        library: Library,
        estimates: Estimates,
        entries: Sequence[Entry],
        tuning: Tuning,
        settings: ViewSettings,
        survey: FollowedSurvey,
        timeline: LiveTimeline,
        tasks: Tasks,
    ) -> None:
        self._client = client
        self.library, self.estimates = library, estimates
        self.tuning, self.settings = tuning, settings
        self.survey, self.timeline, self.tasks = survey, timeline, tasks
        self.open_requests = OpenRequests(library, entries)
        self.opened: Opened | None = None
        self.clock = PlaybackClock([0.0])
        self.frame = 0
        self.time_seek: TimeSeek | None = None
        self.scene = Scene(client, settings)
        self.framing = Framing(client, self.scene)
        self.renderer = SceneRenderer(client, self.scene)
        self.pair: Pair | None = None
        self.preset_use: PresetUse | None = None
        self.outbox: list[Message] = []
        self._other: Pair | None = None
        self._drawn: tuple[Opened, int, Parameters, Comparison | None] | None = None
        self._selection = Selection()
        self._picked: int | None = None
        self._picked_in_scene = 0

    def open_next(self) -> None:
        """Open the next requested recording in place of the open one.

        Raises:
            InputError: requested recordings could not be opened, and none is left to try.
        """
        opened = self.open_requests.try_next()
        if opened is not None:
            self._begin(opened)
        self.open_requests.raise_failure()

    def draw(self) -> None:
        """Draw the frame that is due, if anything has changed."""
        if self.opened is None:
            return
        if self.clock.playing:
            self.frame = self.clock.advance(time.monotonic())
        parameters = self.tuning.parameters
        wanted = (self.opened, self.frame, parameters, self.tuning.comparison)
        try:
            if wanted != self._drawn:
                self._draw_pairs(*wanted)
        finally:
            self.survey.follow(self.opened, parameters)

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
        """Change some settings of the drawing, {name: value}."""
        self.settings = replace(self.settings, **values)
        self.scene.change(self.settings)

    def pick(self, cluster: int | None) -> None:
        """Pick the cluster with this index, or none."""
        if self.pair is not None:
            self._selection.pick(self.pair, cluster)
            self._picked = self._selection.follow(self.pair)
            self.scene.mark(self.pair, cluster_of(self.pair, self._picked))

    def pick_at(self, origin: Sequence[float], direction: Sequence[float]) -> None:
        """Pick the cluster hit by a ray, origin and direction (3,) in the drawing, or none."""
        if self.pair is not None:
            ray = (self.scene.in_fixed_frame(np.array(v)) for v in (origin, direction))
            self.pick(cluster_at(self.pair, *ray))
            self._picked_in_scene += self._picked is not None

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
        )

    def restore(self, saved: SavedSession) -> None:
        """Restore a saved session, after opening its recording and before drawing.

        Its parameters and settings were already given to the session at its start.
        """
        self.seek(saved.frame)
        self.tuning.comparison = saved.comparison
        if saved.camera:
            self.framing.start_from(saved.camera)
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
            pair=self.pair,
            other=self._other,
            picked=self._picked,
            picked_in_scene=self._picked_in_scene,
            playing=self.clock.playing,
            playback=self.clock.playback,
            timeline=self.timeline.of(self.opened, self.tuning.parameters),
            seeking=seeking,
            time_seek=self.time_seek,
            survey=self.survey.survey,
            survey_revision=self.survey.revision,
            **self._status(),
        )

    def close(self) -> None:
        """End all tasks, and release the recording."""
        self.tasks.end()
        if self.opened is not None:
            self._release(self.opened)
            self.opened = None

    def _begin(self, opened: Opened) -> None:
        before, self.opened = self.opened, opened
        if before is not None:
            self._release(before)
        recording = opened.recording
        self.clock = PlaybackClock(recording.stamps, like=self.clock.playback)
        self.frame = first_frame_with_flow(opened, self.tuning.parameters, self.estimates)
        self.time_seek = None
        self._selection.drop()
        with self._client.atomic():
            self.scene.open(recording)
        self.outbox += [
            Notice(opened.entry.label, warning, "yellow", seconds=15.0)
            for warning in recording.warnings
        ]

    def _release(self, opened: Opened) -> None:
        self.survey.stop()
        self.library.release(opened.entry)

    def _status(self) -> dict[str, Any]:
        outbox, self.outbox = tuple(self.outbox), []
        return {
            "opening": self.open_requests.label,
            "parameters": self.tuning.parameters,
            "parameters_revision": self.tuning.revision,
            "refusals": dict(self.tuning.refusals),
            "preset_use": self.preset_use,
            "tasks": self.tasks.states,
            "outbox": outbox,
        }

    def _draw_pairs(
        self, opened: Opened, frame: int, parameters: Parameters, comparison: Comparison | None
    ) -> None:
        self.pair = self._other = None
        found = estimate_frame(self.estimates, opened, frame, parameters, comparison)
        self.pair, self._other = found.pair, found.other
        with self._client.atomic():
            self._picked = self._selection.follow(found.pair)
            self.scene.show(
                found.pair,
                found.second,
                comparison.edited if comparison else A,
                cluster_of(found.pair, self._picked),
            )
            if self._drawn is None or self._drawn[0] is not opened:
                self.framing.begin(found.pair)
            else:
                self.framing.retry_first_view(found.pair)
        self._drawn = (opened, frame, parameters, comparison)
        if found.problem is not None:
            raise found.problem
