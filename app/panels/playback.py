"""Controls of playback: slider, timeline, play, steps, speed, loop and range."""

from typing import Any

import viser
from viser import Icon

from app.analysis.library import Opened
from app.browser.controls import show_value
from app.browser.fields import sets_along
from app.panels.panel import Panel, PanelContext
from app.panels.playback_commands import (
    STEPS,
    ChangePlayback,
    JumpToMotion,
    add_commands,
    speed_name,
)
from app.panels.timeline_strip import strip
from app.panels.triggers import post_chosen, post_on
from app.session.clock import SPEEDS, Playback
from app.session.commands import TogglePlay, seek, step
from app.session.snapshot import Snapshot

_JUMPS = {"Previous": -1, "Next": 1}
_SPEEDS = {speed_name(speed): speed for speed in SPEEDS}


class PlaybackPanel(Panel):
    """Controls to seek and play."""

    def __init__(self, context: PanelContext) -> None:
        gui, post = context.client.gui, context.post
        self._post = post
        self._arrived = False
        with gui.add_folder("Playback"):
            self._slider = gui.add_slider(
                "Frame", min=0, max=1, step=1, initial_value=0, hint="The frame k that is shown."
            )
            self._strip = gui.add_html("")
            self._time = gui.add_html("")
            self._play = gui.add_button("Play", icon=Icon.PLAYER_PLAY, hint="Space")
            steps = gui.add_button_group(
                "Step",
                tuple(STEPS),
                hint="Frames. Keys: J and L or the arrows, ten with Shift and an arrow; Home, End.",
            )
            jumps = gui.add_button_group(
                "Motion",
                tuple(_JUMPS),
                hint="To where something begins to move: by the truth, or by the estimates so far. "
                "Keys: Shift+M and M.",
            )
            self._speed = gui.add_dropdown(
                "Speed",
                tuple(_SPEEDS),
                initial_value=speed_name(1.0),
                hint="Of the recording's own. Keys: Shift+J slower, Shift+L faster.",
            )
            with gui.add_folder("Loop and range", expand_by_default=False):
                self._loop = gui.add_checkbox(
                    "Loop", False, hint="Play the range again and again. Key: R."
                )
                self._range = gui.add_multi_slider(
                    "Range", min=0, max=1, step=1, initial_value=(0, 1), hint="Frames to play."
                )

        # Coroutines run at once, before the control's value can change again.
        @self._slider.on_update
        async def _(event: viser.GuiEvent) -> None:
            if event.client_id is not None:
                post(seek(self._slider.value))

        post_on(post, TogglePlay(), self._play)

        @steps.on_click
        async def _(_: viser.GuiEvent) -> None:
            post_chosen(post, steps, STEPS, step)

        @jumps.on_click
        async def _(_: viser.GuiEvent) -> None:
            post_chosen(post, jumps, _JUMPS, lambda direction: JumpToMotion((direction,)))

        @self._speed.on_update
        async def _(event: viser.GuiEvent) -> None:
            if event.client_id is not None:
                post_chosen(
                    post, self._speed, _SPEEDS, lambda speed: ChangePlayback({"speed": speed})
                )

        @self._loop.on_update
        async def _(event: viser.GuiEvent) -> None:
            self._change(event, loop=self._loop.value)

        @self._range.on_update
        async def _(event: viser.GuiEvent) -> None:
            ends = [frame for frame in self._range.value if isinstance(frame, int)]
            if len(ends) == 2:  # a browser may send anything
                self._change(event, first=ends[0], last=ends[1])

        self._followed: Playback | None = None
        add_commands(gui, post)

    def open(self, opened: Opened) -> None:
        """Set the controls' range to the recording's frames."""
        last = max(len(opened.recording) - 1, 0)
        self._slider.max = last
        self._range.max = max(last, 1)
        show_value(self._range, (0, max(last, 1)))
        self._range.visible = last > 0
        self._arrived = False

    def show(self, snapshot: Snapshot) -> None:
        """Show the current frame and the state of playback."""
        stamps = snapshot.opened.recording.stamps
        if not snapshot.seeking:
            show_value(self._slider, snapshot.frame)
        time, end = stamps[snapshot.frame] - stamps[0], stamps[-1] - stamps[0]
        self._time.content = (
            '<div style="font-size: 0.75rem; padding: 0 1em 0.4em; opacity: 0.75;'
            ' font-variant-numeric: tabular-nums">'
            f"Frame {snapshot.frame} of {len(stamps) - 1}, at {time:.2f} s of {end:.2f} s</div>"
        )
        self._play.label = "Pause" if snapshot.playing else "Play"
        self._play.icon = Icon.PLAYER_PAUSE if snapshot.playing else Icon.PLAYER_PLAY
        self._strip.content = strip(
            snapshot.timeline,
            snapshot.playback,
            snapshot.settings.palette,
            sets_along(self._slider, len(stamps) - 1),
        )
        self._follow(snapshot.playback)

    def _follow(self, playback: Playback) -> None:
        # Keys change speed and loop, too. Unchanged controls are not set, since the user may be
        # moving them; the range, which has no keys, is set only once per recording.
        if playback != self._followed:
            self._followed = playback
            show_value(self._speed, speed_name(playback.speed))
            show_value(self._loop, playback.loop)
        if not self._arrived:
            self._arrived = True
            show_value(self._range, (playback.first, max(playback.last, 1)))

    def _change(self, event: viser.GuiEvent, **values: Any) -> None:  # noqa: ANN401 (any field)
        if event.client_id is not None:
            self._post(ChangePlayback(values))
