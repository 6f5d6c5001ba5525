"""Clusters of a pair as a CSV file, with every round of ICP."""

import csv
import io
import math

from app.analysis.pairs import Pair
from app.exports.csv_heading import described
from app.output.export_kinds import CLUSTERS_HEADING
from app.output.text import csv_cell
from estimator import ClusterResult, IcpRound, Parameters
from recordings import Recording

_HEADER = (
    "frame",
    "cluster",
    "label",
    "round",
    "source points",
    "target points",
    "fitness",
    "mean displacement [m]",
    "source inliers",
    "target inliers",
    "reason",
)


def cluster_csv(recording: Recording, pair: Pair, parameters: Parameters) -> str:
    """Write a pair's clusters as CSV: a comment line, a header with units, a line per round.

    A cluster without a round has one line. Undefined values are left empty.

    Args:
        recording: of the pair.
        pair: with a flow.
        parameters: of its estimate.
    """
    assert pair.flow is not None
    text = io.StringIO()
    text.write(f"# {CLUSTERS_HEADING} of frame {pair.frame}; {described(recording, parameters)}\n")
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(_HEADER)
    for cluster in pair.flow.clusters:
        about = (pair.frame, cluster.index, cluster.label.name.lower())
        rounds = [_round_cells(count, turn) for count, turn in enumerate(cluster.rounds, start=1)]
        for cells in rounds or [_without_rounds(cluster)]:
            writer.writerow([csv_cell(str(cell)) for cell in (*about, *cells, cluster.reason)])
    return text.getvalue()


def _round_cells(count: int, turn: IcpRound) -> tuple[object, ...]:
    return (
        count,
        turn.source_size,
        turn.target_size,
        _number(turn.fitness),
        _number(turn.mean_displacement),
        len(turn.inlier_source),
        len(turn.inlier_target),
    )


def _without_rounds(cluster: ClusterResult) -> tuple[object, ...]:
    return "", len(cluster.source), len(cluster.target), "", "", "", ""


def _number(value: float) -> str:
    return f"{value:.6g}" if math.isfinite(value) else ""
