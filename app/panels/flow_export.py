"""Command that saves the flow as numbers."""

from collections.abc import Sequence
from dataclasses import dataclass

from app.errors import InputError
from app.exports.file_names import safe
from app.exports.flow_file import flow_file, flow_table
from app.session.command import LatestWins
from app.session.making import Making, delivered, start_making
from app.session.outbox import Message
from app.session.workbench import Workbench

_TITLE = "Flow file"

_MOST_FRAMES = 1000
"""Of a file that goes through the browser; more are for the command line."""


@dataclass(frozen=True)
class SaveFlow(LatestWins):
    """Save the flow of the frame, or of the range that is played.

    Attributes:
        kind: `CSV` or `NPZ`.
        whole: whether it is the range.
    """

    kind: str
    whole: bool

    def apply(self, workbench: Workbench) -> None:
        """Start to write the file.

        Raises:
            InputError: another one is being written, or the range is too long.
        """
        saved = workbench.saved()
        if saved is None or saved.playback is None:
            return
        first, last = saved.playback.first, saved.playback.last
        frames = range(first, last + 1) if self.whole else range(saved.frame, saved.frame + 1)
        if len(frames) > _MOST_FRAMES:
            raise InputError(
                f"{len(frames)} frames are too many for one file here, which holds {_MOST_FRAMES}; "
                "play a part of them, or use tofscope export --flow FILE."
            )
        parameters = saved.parameters

        def make(making: Making) -> Sequence[Message]:
            pairs, opened = [], making.opened
            for k in frames:
                making.step(f"Frame {k}.")
                pairs.append(making.estimates.estimated_in_background(opened, k, parameters))
            table = flow_table(pairs, several=self.whole)
            content = flow_file(opened.recording, parameters, table, self.kind)
            which = f"frames_{first:04d}_{last:04d}" if self.whole else f"frame_{frames[0]:04d}"
            name = f"{safe(opened.recording.name)}_{which}_flow.{self.kind}"
            return delivered(_TITLE, name, content, f"{len(table)} points")

        start_making(workbench, _TITLE, "Estimating frame by frame.", make)
