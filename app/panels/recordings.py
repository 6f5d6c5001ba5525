"""Name of the open recording, the list to choose another from, and the notes on it."""

from dataclasses import asdict, dataclass
from html import escape

import viser
from viser import Icon

from app.analysis.catalogue import About, facts_of
from app.analysis.library import Opened
from app.analysis.notes import all_notes, no_pair_note
from app.analysis.timeline import Timeline, has_counting_pair
from app.browser.assets import call, run_asset
from app.browser.opening_card import end_opening, show_nothing_open, show_opening
from app.browser.page_events import EventContent, NoContent
from app.output.text import escaped
from app.panels.panel import Panel, PanelContext
from app.panels.triggers import post_on
from app.session.choice import Listing
from app.session.command import LatestWins
from app.session.commands import OpenRecording
from app.session.outbox import Notice
from app.session.snapshot import Snapshot, Status
from app.session.workbench import Workbench

_NOTHING = "No recording is open."


class _Chosen(EventContent):
    label: str


class _Step(EventContent):
    steps: int


class _Seen(EventContent):
    rows: tuple[int, ...]


@dataclass(frozen=True)
class LookAtList(LatestWins):
    """List the recordings as they are now, and find out what is in them.

    Attributes:
        show: whether the page shall show the list.
    """

    show: bool = False

    def apply(self, workbench: Workbench) -> None:
        """List them."""
        workbench.choice.look(show=self.show)
        workbench.open_requests.allow(workbench.choice.listing.entries)


@dataclass(frozen=True)
class LookFirst(LatestWins):
    """Find out first what is in the recordings in these rows of the list."""

    rows: tuple[int, ...]

    def apply(self, workbench: Workbench) -> None:
        """Prefer them."""
        workbench.choice.prefer(self.rows)


@dataclass(frozen=True)
class LeaveList(LatestWins):
    """The list is not shown any more."""

    def apply(self, workbench: Workbench) -> None:
        """Find out nothing more."""
        workbench.choice.leave()


@dataclass(frozen=True)
class OpenNeighbour:
    """Open the recording so many places on in the list, or back where negative."""

    steps: int

    def merged_with(self, earlier: "OpenNeighbour") -> "OpenNeighbour":
        """Add up the steps."""
        return OpenNeighbour(earlier.steps + self.steps)

    def apply(self, workbench: Workbench) -> None:
        """Request it and those behind it, of which the first that opens counts."""
        if not self.steps:
            return
        found = workbench.choice.neighbours(workbench.opened, self.steps)
        workbench.open_requests.allow(workbench.choice.listing.entries)
        workbench.open_requests.request(found)
        if not found:
            end = "last" if self.steps > 0 else "first"
            said = f"This is the {end} recording that can be opened."
            workbench.outbox.append(Notice("Recordings", said, replaces=True))


class RecordingsPanel(Panel):
    """Name of the open recording, which opens the list, and what is to be known about it."""

    def __init__(self, context: PanelContext) -> None:
        self._client = context.client
        for name in (
            "recordings.css",
            "notices.css",
            "notices.js",
            "recordings.js",
            "notes.js",
            "failure.js",
        ):
            run_asset(self._client, name)
        self._panel = self._client.gui.add_html(_html("…", "Opening …", (), ""))
        self._shown: Opened | None = None
        self._notes: tuple[str, ...] = ()
        self._known: tuple[Opened, tuple[str, ...], str] | None = None
        self._paired: tuple[Timeline, int] | None = None
        self._no_pair = ""
        self._listing = Listing(())
        self._told: dict[str, About] = {}
        self._opening: str | None = None
        self._receive(context)
        _add_commands(self._client.gui, context)

    def announce(self, status: Status) -> None:
        """Say what is being opened, until the first of it is shown, or that nothing is open."""
        opened, opening = status.opened, status.opening
        if opening is None and opened is not None and opened is not self._shown:
            opening = opened.entry.label
        self._say_opening(opening, opened)
        if opening is None and opened is not None:
            self._describe(opened)
        else:
            self._known = None
            name = "Choose a recording" if opening is None else opening
            self._say(name, _NOTHING if opening is None else f"Opening {opening} …", ())
        self._list(status.listing, opened)

    def show(self, snapshot: Snapshot) -> None:
        """Describe what is open, also after a recording that could not be opened."""
        self._shown = snapshot.opened
        self._look_for_pairs(snapshot)
        self._say_opening(None, snapshot.opened)
        self._describe(snapshot.opened)

    def _receive(self, context: PanelContext) -> None:
        events, post = context.events, context.post
        events.on("recordings.look", NoContent, lambda _: post(LookAtList()))
        events.on("recordings.close", NoContent, lambda _: post(LeaveList()))
        events.on("recordings.seen", _Seen, lambda seen: post(LookFirst(seen.rows)))
        events.on("recordings.choose", _Chosen, lambda chosen: post(OpenRecording(chosen.label)))
        events.on(
            "recordings.step", _Step, lambda step: post(OpenNeighbour(1 if step.steps > 0 else -1))
        )

    def _say_opening(self, label: str | None, opened: Opened | None) -> None:
        """Show what is being opened over the scene, or the scene alone."""
        wanted = label if label is not None else _NOTHING if opened is None else ""
        if wanted == self._opening:
            return
        self._opening = wanted
        if label is not None:
            show_opening(self._client, label)
        elif opened is None:
            show_nothing_open(self._client, f"{_NOTHING} Choose one from the list: key O.")
        else:
            end_opening(self._client)

    def _describe(self, opened: Opened) -> None:
        """Say what is open, with the notes on it, of which some come with further frames."""
        no_pair = self._no_pair if opened is self._shown else ""
        known = opened, opened.recording.warnings, no_pair
        if known != self._known:
            self._known = known
            notes = [*all_notes(opened.recording), *([no_pair] if no_pair else [])]
            self._say(opened.entry.label, about(opened), tuple(notes))

    def _look_for_pairs(self, snapshot: Snapshot) -> None:
        """Find out why there may be no errors to see, where there is truth."""
        paired = snapshot.timeline, snapshot.parameters.n
        if paired == self._paired:
            return
        self._paired = paired
        known = snapshot.opened.recording.has_truth and not snapshot.timeline.unread
        known = known and not has_counting_pair(*paired)
        self._no_pair = f"The recording has {no_pair_note(paired[1])}." if known else ""

    def _say(self, name: str, said: str, notes: tuple[str, ...]) -> None:
        hint = "\n".join([name, *(() if self._shown is None else details(self._shown))])
        content = _html(name, said, notes, hint)
        self._panel.content = content
        if notes != self._notes:
            self._notes = notes
            call(self._client, "notes.fill", escaped(name), [*map(escaped, notes)])

    def _list(self, listing: Listing, opened: Opened | None) -> None:
        """Fill the list that the page shows, with what is new."""
        before, self._listing = self._listing, listing
        if listing.looks != before.looks:
            labels = [entry.label for entry in listing.entries]
            call(self._client, "recordings.fill", labels, opened and opened.entry.label)
            self._told = {}
        if listing.shown != before.shown:
            call(self._client, "recordings.show")
        if listing.looks and listing.about is not before.about:
            new = {k: v for k, v in listing.about.items() if self._told.get(k) != v}
            self._told |= new
            if new:
                call(self._client, "recordings.describe", {k: asdict(v) for k, v in new.items()})


def about(opened: Opened) -> str:
    """What a recording is, in a line: a simulated one says so first."""
    facts, recording = facts_of(opened.recording), opened.recording
    count = facts.sensors
    sensors = "1 sensor" if count == 1 else f"{count} sensors"
    frames = "1 frame" if facts.frames == 1 else f"{facts.frames} frames"
    size = f"{sensors}, {frames}, {facts.seconds:.1f} s"
    if not recording.simulated:
        return size
    return f"Simulated: {facts.scenario} · {size}" if facts.scenario else f"Simulated · {size}"


def details(opened: Opened) -> list[str]:
    """Further lines about a recording, for whom asks."""
    return [about(opened), f"Fixed frame: {opened.recording.fixed_frame}"]


def _add_commands(gui: viser.GuiApi, context: PanelContext) -> None:
    choosing = gui.add_command("Choose a recording", hotkey="O", icon=Icon.LIST_SEARCH)
    following = gui.add_command("Next recording", hotkey="N", icon=Icon.CHEVRON_RIGHT)
    previous = gui.add_command(
        "Previous recording", hotkey="N", modifier="shift", icon=Icon.CHEVRON_LEFT
    )
    post_on(context.post, LookAtList(show=True), choosing)
    post_on(context.post, OpenNeighbour(1), following)
    post_on(context.post, OpenNeighbour(-1), previous)


def _html(name: str, said: str, notes: tuple[str, ...], hint: str) -> str:
    """Two lines, whatever they say, so that the controls below stay in place."""
    count = len(notes)
    of_notes = "1 note" if count == 1 else f"{count} notes"
    notes_button = (
        f'<button data-recordings="notes" title="What is to be known about it">{of_notes}</button>'
    )
    return (
        '<div class="tofscope-recording">'
        f'<button class="tofscope-chosen" data-recordings="show" title="{escape(hint)}"'
        f' aria-label="Recording: {escape(name)}" aria-haspopup="dialog">'
        f"<span>{escape(name)}</span>▾</button>"
        '<button data-recordings="-1" aria-label="Previous recording"'
        ' title="Previous recording (Shift N)">‹</button>'
        '<button data-recordings="1" aria-label="Next recording"'
        ' title="Next recording (N)">›</button></div>'
        f'<div class="tofscope-about"><span title="{escape(said)}">{escape(said)}</span>'
        f"{notes_button if notes else ''}</div>"
    )
