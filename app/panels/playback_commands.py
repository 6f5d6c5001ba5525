"""Commands of playback, with their keys and entries in the command palette."""

from collections.abc import Callable
from dataclasses import dataclass
from time import monotonic
from typing import Any, Self

import viser
from viser import Icon

from app.analysis.timeline import neighbour
from app.panels.triggers import post_on
from app.session.clock import SPEEDS
from app.session.command import Command, LatestOfEach, Repeated
from app.session.commands import TogglePlay, seek, step
from app.session.outbox import Notice
from app.session.workbench import Workbench

_LAST = 1_000_000_000  # frames: beyond the end of every recording


@dataclass(frozen=True)
class ChangePlayback(LatestOfEach):
    """Change playback, {field of `Playback`: value}."""

    def apply(self, workbench: Workbench) -> None:
        """Change the fields."""
        workbench.clock.change(dict(self.values), workbench.frame, monotonic())


@dataclass(frozen=True)
class JumpToMotion:
    """Seek to starts of motion.

    Attributes:
        directions: onwards (1) or backwards (-1).
    """

    directions: tuple[int, ...]

    def merged_with(self, earlier: Self) -> Self:
        """Both, one after the other."""
        return type(self)(earlier.directions + self.directions)

    def apply(self, workbench: Workbench) -> None:
        """Seek, or post a notice if there is no motion in a direction."""
        for direction in self.directions:
            _jump(workbench, direction)


@dataclass(frozen=True)
class ChangeSpeed:
    """Change speed by this many of the selectable speeds, negative for slower."""

    steps: int

    def merged_with(self, earlier: Self) -> Self:
        """Add up the steps."""
        return type(self)(earlier.steps + self.steps)

    def apply(self, workbench: Workbench) -> None:
        """Set the speed."""
        clock = workbench.clock
        index = SPEEDS.index(clock.playback.speed) + self.steps
        speed = SPEEDS[min(max(index, 0), len(SPEEDS) - 1)]
        clock.change({"speed": speed}, workbench.frame, monotonic())


@dataclass(frozen=True)
class ToggleLoop(Repeated):
    """Toggle the loop, this many times."""

    def apply(self, workbench: Workbench) -> None:
        """Switch the loop on or off."""
        clock = workbench.clock
        loop = clock.playback.loop ^ bool(self.times % 2)
        clock.change({"loop": loop}, workbench.frame, monotonic())


def add_commands(gui: viser.GuiApi, post: Callable[[Command], None]) -> None:
    """Add the commands to the command palette, with keys."""

    def add(
        label: str,
        posted: Command,
        key: Any = None,  # noqa: ANN401 (viser's literals)
        modifier: Any = None,  # noqa: ANN401
        icon: Any = None,  # noqa: ANN401
    ) -> None:
        post_on(post, posted, gui.add_command(label, hotkey=key, modifier=modifier, icon=icon))

    add("Play or pause", TogglePlay(), "space", icon=Icon.PLAYER_PLAY)
    add("Previous frame", step(-1), "J", icon=Icon.PLAYER_TRACK_PREV)
    add("Next frame", step(1), "L", icon=Icon.PLAYER_TRACK_NEXT)
    add("Previous frame (←)", step(-1), "arrowleft", icon=Icon.PLAYER_TRACK_PREV)
    add("Next frame (→)", step(1), "arrowright", icon=Icon.PLAYER_TRACK_NEXT)
    add("Ten frames back", step(-10), "arrowleft", "shift", Icon.CHEVRONS_LEFT)
    add("Ten frames on", step(10), "arrowright", "shift", Icon.CHEVRONS_RIGHT)
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
        far = " as far as the truth was read" if timeline.unread else ""
        if not workbench.opened.recording.has_truth:
            far = " in the frames estimated so far"
        said = f"Nothing begins to move {where} this frame{far}."
        workbench.outbox.append(Notice("Motion", said, replaces=True))
    else:
        workbench.seek(frame)
