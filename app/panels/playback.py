"""Which frame is shown: slider, play and pause, steps."""

from collections.abc import Callable

import viser
from viser import Icon

from app.library import Opened
from app.mailbox import Wish
from app.panel import Desk, Panel, Shown
from app.wishes import Seek, Step, TogglePlay

_STEPS = {"-10": -10, "-1": -1, "+1": 1, "+10": 10}


class PlaybackPanel(Panel):
    """Scrub and play."""

    def __init__(self, desk: Desk) -> None:
        gui, post = desk.client.gui, desk.post
        with gui.add_folder("Playback"):
            self._slider = gui.add_slider(
                "Frame", min=0, max=1, step=1, initial_value=0, hint="The frame k that is shown."
            )
            self._time = gui.add_html("")
            self._play = gui.add_button("Play", icon=Icon.PLAYER_PLAY, hint="Space")
            steps = gui.add_button_group(
                "Step", tuple(_STEPS), hint="Frames; keys J and L go one back and one on."
            )

        # Coroutines run at once, before anything can change a control's value again.
        @self._slider.on_update
        async def _(event: viser.GuiEvent) -> None:
            if event.client_id is not None:
                post(Seek(self._slider.value))

        @self._play.on_click
        async def _(_: viser.GuiEvent) -> None:
            post(TogglePlay())

        @steps.on_click
        async def _(_: viser.GuiEvent) -> None:
            post(Step(_STEPS[steps.value]))

        _add_keys(gui, post)

    def open(self, opened: Opened) -> None:
        """Prepare for a recording's frames."""
        self._slider.max = max(len(opened.recording) - 1, 0)

    def show(self, shown: Shown) -> None:
        """Show where playback is."""
        stamps = shown.opened.recording.stamps
        if not shown.seeking:
            self._slider.value = shown.frame
        self._time.content = (
            '<div style="font-size: 0.75rem; padding: 0 1em; opacity: 0.75">'
            f"Frame {shown.frame} of {len(stamps) - 1}, "
            f"at {stamps[shown.frame] - stamps[0]:.2f} s</div>"
        )
        self._play.label = "Pause" if shown.playing else "Play"
        self._play.icon = Icon.PLAYER_PAUSE if shown.playing else Icon.PLAYER_PLAY


def _add_keys(gui: viser.GuiApi, post: Callable[[Wish], None]) -> None:
    # Arrow keys are left to the sliders, which they move while one has the focus.
    gui.add_command("Play or pause", hotkey="space").on_trigger(lambda _: post(TogglePlay()))
    gui.add_command("One frame back", hotkey="J").on_trigger(lambda _: post(Step(-1)))
    gui.add_command("One frame on", hotkey="L").on_trigger(lambda _: post(Step(1)))
