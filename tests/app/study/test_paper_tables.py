from math import sqrt

import pytest

from app.study.paper import paper_numbers
from app.study.paper_tables import paper_tables
from tests.app.study.made import PLAN, good, made


def test_the_papers_numbers_are_those_that_it_prints():
    rows = paper_numbers().rows
    assert len(rows) == 16
    ours = [rows["towards", "paper", speed] for speed in (0.15, 0.20, 0.25, 0.30)]
    assert [row.angle_mean for row in ours] == [9.197, 7.663, 7.842, 10.313]
    assert [row.velocity_std for row in ours] == [0.008, 0.012, 0.009, 0.013]
    last = rows["robot_moving", "paper", 0.30]
    assert (last.angle_mean, last.angle_std) == (20.822, 8.010)
    assert (last.velocity_mean, last.velocity_std) == (0.118, 0.034)
    assert rows["towards", "baseline", 0.30].angle_mean == 100.634
    assert rows["sideways", "paper", 0.15].angle_std == 0.073


def test_a_cell_is_mean_and_sample_deviation_over_trials_beside_the_papers():
    rows = [
        made(trial=2, metrics=good(10.0, 0.05)),
        made(trial=1, metrics=good(6.0, 0.03)),
        made(trial=1, method="baseline", metrics=good(80.0, 0.2)),
        made(trial=1, n=10, metrics=good(1.0, 0.01)),
        made("sideways", trial=1, metrics=good(2.0, 0.02)),
    ]
    first, second = paper_tables(PLAN, rows)
    line = next(
        r for r in first.rows if r["speed"] == 0.30 and r["experiment"] == "y-axis (Algorithm 1)"
    )
    assert line["angle_mean"] == pytest.approx(8.0)
    assert line["angle_std"] == pytest.approx(2 * sqrt(2))
    assert line["velocity_mean"] == pytest.approx(0.04)
    assert line["paper_angle_mean"] == 10.313
    assert line["paper_velocity_std"] == 0.013
    assert (line["coverage"], line["precision"], line["trials"]) == (1.0, 0.5, "2/2")
    assert line["pairs"] == 14

    baseline = next(
        r for r in first.rows if r["speed"] == 0.30 and r["experiment"] == "y-axis (baseline)"
    )
    assert (baseline["angle_mean"], baseline["angle_std"]) == (80.0, None)
    assert [row["angle_mean"] for row in second.rows if row["angle_mean"] is not None] == [2.0]


def test_rows_are_in_the_papers_order_and_missing_cells_stay_with_the_papers_numbers():
    first, second = paper_tables(PLAN, [])
    assert [row["speed"] for row in first.rows] == [0.15, 0.20, 0.25, 0.30] * 2
    assert [row["experiment"] for row in first.rows[::4]] == [
        "y-axis (Algorithm 1)",
        "y-axis (baseline)",
    ]
    assert [row["experiment"] for row in second.rows[::8]] == [
        "x-axis (Algorithm 1)",
        "Robot with ToF moving (Algorithm 1)",
    ]
    assert first.rows[0]["angle_mean"] is None
    assert first.rows[0]["trials"] is None
    assert first.rows[0]["paper_angle_mean"] == 9.197


def test_trials_without_a_flow_are_counted_and_left_out_of_the_mean():
    rows = [made(trial=1, metrics=good(6.0, 0.03)), made(trial=2)]
    line = paper_tables(PLAN, rows)[0].rows[3]
    assert (line["angle_mean"], line["trials"]) == (6.0, "1/2")
    assert line["coverage"] == 0.5
