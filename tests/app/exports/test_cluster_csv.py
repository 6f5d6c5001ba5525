import csv

import pytest

from app.analysis.estimates import Estimates
from app.exports.cluster_csv import cluster_csv
from estimator import Label, Parameters
from tests.app.fake_recordings import fake_opened


def table(parameters):
    opened = fake_opened()
    pair = Estimates().estimated(opened, 20, parameters)
    heading, *lines = cluster_csv(opened.recording, pair, parameters).splitlines()
    assert heading.startswith("# Tofscope clusters of frame 20; recording fake.mcap; measured; n=8")
    assert pair.flow is not None
    return pair.flow.clusters, list(csv.DictReader(lines))


def test_every_round_of_every_cluster_has_a_line():
    clusters, rows = table(Parameters())
    assert len(rows) == sum(len(cluster.rounds) for cluster in clusters)
    (moving,) = [cluster for cluster in clusters if cluster.label is Label.MOVING]
    last = [row for row in rows if row["cluster"] == str(moving.index)][-1]
    turn = moving.rounds[-1]
    assert last["label"] == "moving"
    assert last["round"] == str(len(moving.rounds))
    assert last["source points"] == str(turn.source_size)
    assert float(last["fitness"]) == pytest.approx(turn.fitness, rel=1e-5)
    assert float(last["mean displacement [m]"]) == pytest.approx(turn.mean_displacement, rel=1e-5)
    assert last["reason"] == moving.reason


def test_a_cluster_without_a_round_has_a_line_of_its_own():
    _, rows = table(Parameters(n_min=200))
    assert {row["label"] for row in rows} == {"unassigned"}
    assert {row["round"] for row in rows} == {""}
    assert [row["source points"] for row in rows] == ["100"] * 5
