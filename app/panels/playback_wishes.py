"""What a person can wish of playback, and the commands and keys for it."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Self

import viser
from viser import Icon

from app.analysis.timeline import neighbour
from app.session.clock import SPEEDS
from app.session.commands import LatestWins, TogglePlay, seek, step
from app.session.queue import Wish

if TYPE_CHECKING:
    from app.session.workbench import Workbench

STEPS = {"-10": -10, "-1": -1, "+1": 1, "+10": 10}
"""{what a button says: frames to go}."""

_LAST = 1_000_000_000  # frames: beyond the end of every recording


@dataclass(frozen=True)
class ChangePlayback:
    """Play otherwise, {field of `Playback`: value}, from now on."""

    values: Mapping[str, Any]

    def after(self, earlier: Self) -> Self:
        """Both changes, the later value of each field."""
        return type(self)({**earlier.values, **self.values})

    def fulfil(self, workbench: "Workbench") -> None:
        """Take them."""
        workbench.change_playback(dict(self.values))


@dataclass(frozen=True)
class JumpToMotion(LatestWins):
    """Go to where something begins to move, onwards (1) or backwards (-1)."""

    direction: int

    def fulfil(self, workbench: "Workbench") -> None:
        """Go there, or say that there is no such place."""
        timeline = workbench.timeline()
        if timeline is None or workbench.opened is None:
            return
        frame = neighbour(timeline.moving, workbench.frame, self.direction)
        if frame is None:
            where = "after" if self.direction > 0 else "before"
            known = workbench.opened.recording.has_truth
            far = "" if known else " in the frames estimated so far"
            said = f"Nothing begins to move {where} this frame{far}."
            workbench.page.say("Motion", said)
        else:
            workbench.seek(frame)


@dataclass(frozen=True)
class ChangeSpeed:
    """Go this many of the offered speeds faster, or slower where it is negative."""

    steps: int

    def after(self, earlier: Self) -> Self:
        """Both changes."""
        return type(self)(earlier.steps + self.steps)

    def fulfil(self, workbench: "Workbench") -> None:
        """Play so."""
        index = SPEEDS.index(workbench.playback.speed) + self.steps
        speed = SPEEDS[min(max(index, 0), len(SPEEDS) - 1)]
        workbench.change_playback({"speed": speed})


@dataclass(frozen=True)
class ToggleLoop(LatestWins):
    """Loop where it does not, and the other way round."""

    def fulfil(self, workbench: "Workbench") -> None:
        """Play so."""
        workbench.change_playback({"loop": not workbench.playback.loop})


def speed_name(speed: float) -> str:
    """How a speed is written."""
    return f"{speed:g}x"


def speed_from(name: str) -> float:
    """The speed that is written so."""
    return float(name.removesuffix("x"))


def add_commands(gui: viser.GuiApi, post: Callable[[Wish], None]) -> None:
    """Add all of it to the command palette, with keys."""

    def add(
        label: str,
        wish: Wish,
        key: Any = None,  # noqa: ANN401 (viser's literals)
        modifier: Any = None,  # noqa: ANN401
        icon: Any = None,  # noqa: ANN401
    ) -> None:
        command = gui.add_command(label, hotkey=key, modifier=modifier, icon=icon)

        # A coroutine runs at once, so that keys are taken in their order.
        @command.on_trigger
        async def _(_: viser.CommandEvent) -> None:
            post(wish)

    add("Play or pause", TogglePlay(), "space", icon=Icon.PLAYER_PLAY)
    # viser writes the arrows' names as they come; the signs say it better.
    add("Previous frame", step(-1), "J", icon=Icon.PLAYER_TRACK_PREV)
    add("Next frame", step(1), "L", icon=Icon.PLAYER_TRACK_NEXT)
    add("Previous frame (←)", step(-1), "arrowleft", icon=Icon.PLAYER_TRACK_PREV)
    add("Next frame (→)", step(1), "arrowright", icon=Icon.PLAYER_TRACK_NEXT)
    add("Ten frames back (Shift ←)", step(-10), "arrowleft", "shift", Icon.CHEVRONS_LEFT)
    add("Ten frames on (Shift →)", step(10), "arrowright", "shift", Icon.CHEVRONS_RIGHT)
    add("First frame", seek(0), "home", icon=Icon.PLAYER_SKIP_BACK)
    add("Last frame", seek(_LAST), "end", icon=Icon.PLAYER_SKIP_FORWARD)
    add("Next motion", JumpToMotion(1), "M", icon=Icon.RUN)
    add("Previous motion", JumpToMotion(-1), "M", "shift", icon=Icon.RUN)
    add("Slower", ChangeSpeed(-1), "J", "shift", Icon.MULTIPLIER_0_5X)
    add("Faster", ChangeSpeed(1), "L", "shift", Icon.MULTIPLIER_2X)
    add("Loop on or off", ToggleLoop(), "R", icon=Icon.REPEAT)
