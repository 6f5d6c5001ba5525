"""Numbers of a survey on their way to the plots, each frame's once."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from app.analysis.quantities import QUANTITIES
from app.analysis.survey import Survey
from app.browser.plots import LinkedPlots
from recordings import Recording


class PlotFeed:
    """Sends the numbers of one side's survey as it is filled.

    Args:
        plots: that receive them.
        side: A or B.
        names: of the quantities to send.
    """

    def __init__(self, plots: LinkedPlots, side: str, names: Sequence[str]) -> None:
        self._plots, self._side = plots, side
        self._plotted = tuple(names)
        self._survey: Survey | None = None
        self._sent: dict[tuple[str, ...], NDArray[np.bool_]] = {}

    def send(self, recording: Recording, survey: Survey | None, extra: Sequence[str]) -> None:
        """Send what was filled since the last call.

        Args:
            recording: of the survey.
            survey: None until there is one, after a change of parameters.
            extra: further quantities to send.
        """
        if survey is not self._survey:
            if self._sent:
                self._plots.outdate(self._side)
            self._survey, self._sent = survey, {}
        if survey is None:
            return
        known = {*self._plotted, "time"}  # the page has the times already
        more = [(name,) for name in dict.fromkeys(extra) if name not in known]
        done = survey.done.copy()  # it is being filled
        for names in (self._plotted, *more):
            sent = self._sent.get(names, np.zeros(len(done), dtype=bool))
            frames = np.flatnonzero(done & ~sent)
            if len(frames):
                numbers = {n: QUANTITIES[n].values(recording, survey)[frames] for n in names}
                self._plots.add(
                    self._side, frames, self._filled(recording, survey)[frames], numbers
                )
                self._sent[names] = done

    @staticmethod
    def _filled(recording: Recording, survey: Survey) -> NDArray[np.bool_]:
        """Mask (K,) of frames that are drawn filled; without truth there are no means."""
        return survey.counts if recording.has_truth else np.ones(len(survey), dtype=bool)
