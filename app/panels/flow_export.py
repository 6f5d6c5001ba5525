"""Command that saves the flow as numbers."""

from collections.abc import Sequence
from dataclasses import dataclass

from app.errors import InputError
from app.exports.file_names import safe
from app.exports.flow_file import flow_file, flow_table
from app.session.command import LatestWins
from app.session.outbox import Download, Message, Notice
from app.session.tasks import Report
from app.session.workbench import Workbench

_TITLE = "Flow"
_QUIET = 0.02  # seconds without foreground work before the next frame
_PATIENCE = 0.5  # seconds after which it continues in any case

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
        saved, library, estimates = workbench.saved(), workbench.library, workbench.estimates
        if workbench.opened is None or saved is None or saved.playback is None:
            return
        if workbench.tasks.running(_TITLE):
            raise InputError("A file with the flow is being made already; wait until it is there.")
        first, last = saved.playback.first, saved.playback.last
        frames = range(first, last + 1) if self.whole else range(saved.frame, saved.frame + 1)
        if len(frames) > _MOST_FRAMES:
            raise InputError(
                f"{len(frames)} frames are too many for one file here, which holds {_MOST_FRAMES}; "
                "play a part of them, or use tofscope export --flow FILE."
            )
        opened = library.open(workbench.opened.entry)

        def make(report: Report) -> Sequence[Message]:
            try:
                pairs = []
                for k in frames:
                    estimates.foreground.wait_until_quiet(_QUIET, _PATIENCE)
                    report(f"Frame {k}.")
                    pairs.append(estimates.estimated_in_background(opened, k, saved.parameters))
                table = flow_table(pairs, several=self.whole)
                content = flow_file(opened.recording, saved.parameters, table, self.kind)
            finally:
                library.release(opened.entry)
            which = f"frames_{first:04d}_{last:04d}" if self.whole else f"frame_{frames[0]:04d}"
            name = f"{safe(opened.recording.name)}_{which}_flow.{self.kind}"
            sentence = f"{name}, {len(table)} points, is in your downloads."
            return Download(name, content), Notice(_TITLE, sentence, "green", seconds=10.0)

        workbench.tasks.start(_TITLE, "Estimating frame by frame.", make)
