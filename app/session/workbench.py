"""State of one session: everything that a client has open, set and drawn; used by one thread."""

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
from app.session.opening import Opening
from app.session.outbox import Message, Notice
from app.session.presets import PresetUse
from app.session.snapshot import Snapshot, Status, TimeSeek
from app.session.tasks import Tasks
from app.session.tuning import Tuning
from estimator import Parameters


class Workbench:
    """State of a session and the scene that it draws; commands change it, `snapshot` reads it.

    Args:
        client: the browser client, on which the scene is drawn.
        library: opens recordings.
        estimates: computes and remembers.
        entries: the recordings that may be opened.
        tuning: parameters to begin with.
        settings: of the drawing, to begin with.
        survey: of the recording that is open.
        timeline: of the recording that is open.
        tasks: that run in the background.

    Attributes:
        opening: recordings that are to be opened.
        opened: the recording, None while none is open.
        frame: k.
        clock: of the playback.
        time_seek: the last time that a person typed, None where none was.
        tuning: the parameters.
        settings: of the drawing; `change_view` changes them.
        scene: in the client's browser.
        framing: puts the scene's camera to views.
        renderer: takes pictures of the scene.
        pair: that is drawn, None where none is.
        preset_use: the last use of a preset, None where none was used.
        outbox: messages for the browser, taken by the next status or snapshot.
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
        self.opening = Opening(library, entries)
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
        """Open the recording that is wanted next, in place of the one that is open.

        Raises:
            InputError: it cannot be opened and is the last that is wanted, or others before it.
        """
        opened = self.opening.try_next()
        if opened is not None:
            self._begin(opened)
        self.opening.raise_failure()

    def draw(self) -> None:
        """Bring the scene up to date, with whatever frame is due by now."""
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
        """Go to a frame; a number outside the recording means its first or last one."""
        if self.opened is None:
            return
        self.frame = min(max(frame, 0), len(self.opened.recording) - 1)
        if self.clock.playing:
            self.clock.play(self.frame, time.monotonic())

    def toggle_play(self) -> None:
        """Play where it stands still, and the other way round."""
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
        """Pick the cluster under a ray (3,), (3,) of the drawing, or none if it misses all."""
        if self.pair is not None:
            ray = (self.scene.in_fixed_frame(np.array(v)) for v in (origin, direction))
            self.pick(cluster_at(self.pair, *ray))
            self._picked_in_scene += self._picked is not None

    def saved(self) -> SavedSession | None:
        """All that a reload of the page brings back, None where nothing is open."""
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
        """Show what was saved of the recording that is open and not drawn yet.

        Its parameters and settings are those that the session has begun with.
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
        """State that the page shows before anything is opened or drawn; it takes the outbox."""
        return Status(opened=self.opened, **self._status())

    def snapshot(self, *, seeking: bool) -> Snapshot | None:
        """State that the page shows after `draw`; it takes the outbox.

        Args:
            seeking: whether a person is moving the frame slider.

        Returns:
            The snapshot, None where no recording is open.
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
        """End all tasks, and give back the recording."""
        self.tasks.end()
        if self.opened is not None:
            self._leave(self.opened)
            self.opened = None

    def _begin(self, opened: Opened) -> None:
        before, self.opened = self.opened, opened
        if before is not None:
            self._leave(before)
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

    def _leave(self, opened: Opened) -> None:
        self.survey.stop()
        self.library.release(opened.entry)

    def _status(self) -> dict[str, Any]:
        outbox, self.outbox = tuple(self.outbox), []
        return {
            "opening": self.opening.label,
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
