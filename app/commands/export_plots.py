"""Plots over a whole recording, and the clusters of a frame, as `tofscope export` makes them."""

from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING

from app.analysis.comparison import A
from app.analysis.survey import Survey
from app.errors import InputError, UserError
from app.output.writing import write
from estimator import Parameters

if TYPE_CHECKING:
    from app.analysis.estimates import Estimates
    from app.analysis.library import Opened


def make_plots(
    place: Path,
    opened: "Opened",
    parameters: Parameters,
    colours: str,
    estimates: "Estimates",
    progress: Callable[[int], None],
) -> str:
    """Write the plots as the page shows them, or their numbers; what is said of it.

    Args:
        place: file, whose ending says which form it has.
        opened: recording, each frame of which is estimated; broken ones are left out.
        parameters: of the estimates.
        colours: name of the palette.
        estimates: computes the pairs.
        progress: called with the number of frames that are done.
    """
    from app.exports.survey_csv import to_csv
    from app.exports.survey_figure import survey_figure
    from app.panels.plot_list import plots

    recording = opened.recording
    survey = Survey(recording, parameters)
    for k in range(len(recording)):
        progress(k)
        if not survey.done[k]:
            try:
                survey.put(k, estimates.estimated(opened, k, parameters))
            except UserError:
                survey.put(k, None)
    form = place.suffix.lower().removeprefix(".")
    if form == "csv":
        content = to_csv(recording, {A: survey}).encode()
    else:
        names = [quantity.name for quantity in plots(has_truth=recording.has_truth)]
        content = survey_figure(recording, {A: survey}, names, form, colours=colours)
    write(place, content)
    return f"{len(recording)} frames of {recording.name}."


def make_clusters(
    place: Path, opened: "Opened", parameters: Parameters, frame: int, estimates: "Estimates"
) -> str:
    """Write the clusters of a frame with every round of ICP; what is said of it.

    Raises:
        InputError: no frame lies n before it.
    """
    from app.exports.cluster_csv import cluster_csv

    pair = estimates.estimated(opened, frame, parameters)
    if pair.flow is None:
        raise InputError(
            "There are no clusters: no frame lies n before; choose a later frame, or a smaller n."
        )
    write(place, cluster_csv(opened.recording, pair, parameters).encode())
    return f"frame {frame} of {opened.recording.name}, {len(pair.flow.clusters)} clusters."
