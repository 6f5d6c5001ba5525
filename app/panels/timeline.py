"""Timeline along the bottom of the window: transport, tracks, range, marks."""

from dataclasses import dataclass
from typing import Annotated

import numpy as np
import viser
from numpy.typing import NDArray
from pydantic import Field

from app.analysis.library import Opened
from app.analysis.quantities import QUANTITIES, Quantity
from app.analysis.survey import Survey
from app.analysis.timeline import Timeline, covered
from app.browser.assets import ChangedCalls, call, packed, run_asset
from app.browser.page_events import EventContent, NoContent
from app.panels.histograms import upper_limit
from app.panels.panel import Panel, PanelContext
from app.panels.playback_commands import ChangePlayback, JumpToMotion, add_commands
from app.panels.tables import PLOTTED
from app.panels.triggers import post_on
from app.scene.colours import css
from app.scene.palettes import Palette
from app.session.clock import SPEEDS
from app.session.command import LatestWins
from app.session.commands import ChangeView, TogglePlay, seek, step
from app.session.marks import LONGEST_NOTE
from app.session.outbox import Notice
from app.session.snapshot import Snapshot
from app.session.workbench import Workbench

_GAP = 4  # index of the categorical colour of gaps
_MARK = 3  # of marks
_ASSETS = ("timeline.css", "timeline_tracks.js", "timeline_marks.js", "timeline.js")
_FRAMES = 10**9

Frame = Annotated[int, Field(ge=0, lt=_FRAMES)]


class _Seek(EventContent):
    frame: Frame


class _Step(EventContent):
    frames: Annotated[int, Field(ge=-1000, le=1000)]


class _Motion(EventContent):
    direction: Annotated[int, Field(ge=-1, le=1)]


class _Playback(EventContent):
    speed: float | None = None
    loop: bool | None = None
    first: Frame | None = None
    last: Frame | None = None


class _Strip(EventContent):
    name: str


class _Mark(EventContent):
    frame: Frame
    text: Annotated[str, Field(max_length=LONGEST_NOTE)]


@dataclass(frozen=True)
class PutMark:
    """Put a mark at a frame, or remove it.

    Attributes:
        notes: {frame: its note, None to remove the mark}.
    """

    notes: dict[int, str | None]

    def merged_with(self, earlier: "PutMark") -> "PutMark":
        """Both, the later note of a frame."""
        return PutMark({**earlier.notes, **self.notes})

    def apply(self, workbench: Workbench) -> None:
        """Keep them beside the recording."""
        for frame, note in self.notes.items():
            if workbench.marks is None:
                return
            if note is None:
                workbench.marks.remove(frame)
            else:
                workbench.marks.put(frame, note)
                said = f"The mark is kept in {workbench.marks.file.name}, beside the recording."
                workbench.outbox.append(Notice("Marks", said, replaces=True))


@dataclass(frozen=True)
class EditMark(LatestWins):
    """Open the card of a mark at the current frame."""

    def apply(self, workbench: Workbench) -> None:
        """Ask the page to open it."""
        workbench.edited_mark += 1


class TimelinePanel(Panel):
    """Shows where in the recording the session is, and lets a person go elsewhere."""

    def __init__(self, context: PanelContext) -> None:
        self._client, post = context.client, context.post
        self._begin()
        for name in _ASSETS:
            run_asset(context.client, name)
        listen = context.events.on
        listen("play", NoContent, lambda _: post(TogglePlay()))
        listen("seek", _Seek, lambda content: post(seek(content.frame)))
        listen("step", _Step, lambda content: post(step(content.frames)))
        listen("motion", _Motion, lambda content: post(JumpToMotion((content.direction,))))
        listen("mark", _Mark, lambda content: post(PutMark({content.frame: content.text})))
        listen("unmark", _Seek, lambda content: post(PutMark({content.frame: None})))

        def change(content: _Playback) -> None:
            values = {name: value for name, value in content if value is not None}
            if values.get("speed", SPEEDS[0]) in SPEEDS:
                post(ChangePlayback(values))

        def draw(content: _Strip) -> None:
            if content.name in drawable(has_truth=True):
                post(ChangeView({"strip": content.name}))

        listen("playback", _Playback, change)
        listen("strip", _Strip, draw)
        gui = context.client.gui
        add_commands(gui, post)
        mark = gui.add_command("Mark this frame", hotkey="K", icon=viser.Icon.BOOKMARK)
        post_on(post, EditMark(), mark)

    def _begin(self) -> None:
        """Forget what the page was told of another recording."""
        self._calls = ChangedCalls(self._client)
        self._drawn: tuple[str, Survey | None] | None = None
        self._revision = -1
        self._sent = np.zeros((2, 0), dtype="<f4")
        self._edited: int | None = None

    def open(self, opened: Opened) -> None:
        """Show the time of a newly opened recording."""
        stamps = opened.recording.stamps
        self._begin()
        call(self._client, "timeline.open", packed(stamps - stamps[0], "<f4"), SPEEDS)

    def show(self, snapshot: Snapshot) -> None:
        """Show the frame, playback, and what is known of the recording."""
        timeline, playback, settings = snapshot.timeline, snapshot.playback, snapshot.settings
        self._calls.send("timeline.colours", _colours(settings.palette))
        self._calls.send("timeline.events", _events(timeline))
        self._calls.send("timeline.playback", {"playing": snapshot.playing, **vars(playback)})
        self._calls.send("timeline.marks", [vars(mark) for mark in snapshot.marks])
        if not snapshot.seeking:
            self._calls.send("timeline.frame", snapshot.frame)
        self._show_quantity(snapshot)
        if self._edited not in (None, snapshot.edited_mark):
            call(self._client, "timeline.edit", snapshot.frame)
        self._edited = snapshot.edited_mark

    def _show_quantity(self, snapshot: Snapshot) -> None:
        recording, survey = snapshot.opened.recording, snapshot.survey
        options = drawable(has_truth=recording.has_truth)
        chosen = snapshot.settings.strip if snapshot.settings.strip in options else "moving"
        fresh = (chosen, survey) != self._drawn
        if not fresh and snapshot.survey_revision == self._revision:
            return
        self._drawn, self._revision = (chosen, survey), snapshot.survey_revision
        quantity, numbers = options[chosen], np.full((2, len(recording)), np.nan, dtype="<f4")
        if survey is not None:
            numbers[:] = quantity.values(recording, survey), survey.valid
        sizes = np.abs(numbers[0][np.isfinite(numbers[0])])
        about = {
            "title": quantity.title,
            "unit": quantity.unit,
            "top": 1.0 if quantity.kind == "share" else upper_limit([float(sizes.max(initial=0))]),
            "signed": quantity.kind == "signed",
            "options": [(name, option.title) for name, option in options.items()],
            "chosen": chosen,
            "truth": recording.has_truth,
        }
        self._calls.send("timeline.quantity", about)
        self._send_numbers(numbers, fresh=fresh)

    def _send_numbers(self, numbers: NDArray[np.float32], *, fresh: bool) -> None:
        """Send the quantity and the share of valid zones (2, K), where they are new."""
        if fresh:
            call(self._client, "timeline.forget")
            self._sent = np.full_like(numbers, np.nan)
        same = (numbers == self._sent) | (np.isnan(numbers) & np.isnan(self._sent))
        new = ~same.all(axis=0)
        if new.any():
            values = (packed(row[new], "<f4") for row in numbers)
            call(self._client, "timeline.numbers", _bits(new), *values)
        self._sent = numbers


def drawable(*, has_truth: bool) -> dict[str, Quantity]:
    """{name: quantity} that the timeline can draw: those of the plots, and what was measured."""
    return {
        name: quantity
        for name, quantity in QUANTITIES.items()
        if name in (*PLOTTED, "moving", "speed", "points", "clusters", "interval")
        and (has_truth or not quantity.needs_truth)
    }


def _events(timeline: Timeline) -> dict[str, object]:
    """What is marked, in a size that the number of frames bounds."""
    gaps = np.zeros(timeline.count, dtype=bool)
    gaps[list(timeline.gaps)] = True
    return {
        "moving": _bits(covered(timeline.moving, timeline.count)),
        "empty": _bits(covered(timeline.empty, timeline.count)),
        "gaps": _bits(gaps),
        "unread": timeline.unread,
    }


def _bits(flags: NDArray[np.bool_]) -> str:
    """Flags (K,) for our scripts, eight in a byte, the first in its highest bit."""
    return packed(np.packbits(flags), "u1")


def _colours(palette: Palette) -> dict[str, str]:
    return {
        "flow": css(palette.flow),
        "empty": css(palette.unassigned),
        "gap": css(palette.category(_GAP)),
        "mark": css(palette.category(_MARK)),
    }
