"""Commands of playback, and the command palette's entries and keys for them."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from time import monotonic
from typing import Any, Self

import viser
from viser import Icon

from app.analysis.timeline import neighbour
from app.session.clock import SPEEDS
from app.session.command import Command, Repeated
from app.session.commands import TogglePlay, seek, step
from app.session.outbox import Notice
from app.session.workbench import Workbench

STEPS = {"-10": -10, "-1": -1, "+1": 1, "+10": 10}
"""{what a button says: frames to go}."""

_LAST = 1_000_000_000  # frames: beyond the end of every recording


@dataclass(frozen=True)
class ChangePlayback:
    """Play otherwise, {field of `Playback`: value}, from now on."""

    values: Mapping[str, Any]

    def merged_with(self, earlier: Self) -> Self:
        """Both changes, the later value of each field."""
        return type(self)({**earlier.values, **self.values})

    def apply(self, workbench: Workbench) -> None:
        """Take them."""
        workbench.clock.change(dict(self.values), workbench.frame, monotonic())


@dataclass(frozen=True)
class JumpToMotion:
    """Go to where something begins to move, as often as there are directions.

    Attributes:
        directions: onwards (1) or backwards (-1).
    """

    directions: tuple[int, ...]

    def merged_with(self, earlier: Self) -> Self:
        """Both, one after the other."""
        return type(self)(earlier.directions + self.directions)

    def apply(self, workbench: Workbench) -> None:
        """Go there, or say that there is no such place."""
        for direction in self.directions:
            _jump(workbench, direction)


@dataclass(frozen=True)
class ChangeSpeed:
    """Go this many of the offered speeds faster, or slower where it is negative."""

    steps: int

    def merged_with(self, earlier: Self) -> Self:
        """Both changes."""
        return type(self)(earlier.steps + self.steps)

    def apply(self, workbench: Workbench) -> None:
        """Play so."""
        clock = workbench.clock
        index = SPEEDS.index(clock.playback.speed) + self.steps
        speed = SPEEDS[min(max(index, 0), len(SPEEDS) - 1)]
        clock.change({"speed": speed}, workbench.frame, monotonic())


@dataclass(frozen=True)
class ToggleLoop(Repeated):
    """Loop where it does not, and the other way round, this many times."""

    def apply(self, workbench: Workbench) -> None:
        """Play so."""
        clock = workbench.clock
        loop = clock.playback.loop ^ bool(self.times % 2)
        clock.change({"loop": loop}, workbench.frame, monotonic())


def speed_name(speed: float) -> str:
    """Speed as the page writes it."""
    return f"{speed:g}x"


def speed_from(name: str) -> float:
    """Speed from what the page writes."""
    return float(name.removesuffix("x"))


def add_commands(gui: viser.GuiApi, post: Callable[[Command], None]) -> None:
    """Add all of it to the command palette, with keys."""

    def add(
        label: str,
        posted: Command,
        key: Any = None,  # noqa: ANN401 (viser's literals)
        modifier: Any = None,  # noqa: ANN401
        icon: Any = None,  # noqa: ANN401
    ) -> None:
        command = gui.add_command(label, hotkey=key, modifier=modifier, icon=icon)

        # A coroutine runs at once, so that keys are taken in their order.
        @command.on_trigger
        async def _(_: viser.CommandEvent) -> None:
            post(posted)

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
    add("Next motion", JumpToMotion((1,)), "M", icon=Icon.RUN)
    add("Previous motion", JumpToMotion((-1,)), "M", "shift", icon=Icon.RUN)
    add("Slower", ChangeSpeed(-1), "J", "shift", Icon.MULTIPLIER_0_5X)
    add("Faster", ChangeSpeed(1), "L", "shift", Icon.MULTIPLIER_2X)
    add("Loop on or off", ToggleLoop(), "R", icon=Icon.REPEAT)


def _jump(workbench: Workbench, direction: int) -> None:
    if workbench.opened is None:
        return
    timeline = workbench.timeline.of(workbench.opened, workbench.tuning.parameters)
    frame = neighbour(timeline.moving, workbench.frame, direction)
    if frame is None:
        where = "after" if direction > 0 else "before"
        known = workbench.opened.recording.has_truth
        far = "" if known else " in the frames estimated so far"
        said = f"Nothing begins to move {where} this frame{far}."
        workbench.outbox.append(Notice("Motion", said, replaces=True))
    else:
        workbench.seek(frame)
