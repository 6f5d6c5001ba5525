from dataclasses import replace
from pathlib import Path

import pytest

from app.study.further_tables import (
    ablation_table,
    metrics_table,
    recordings_table,
    scenarios_table,
    sweep_table,
)
from app.study.paper_tables import paper_tables
from app.study.work import Recorded
from estimator import ERROR_SYMBOLS, METRIC_INFO
from recordings.simulation import IMPERFECTIONS, NOISE_MODELS
from tests.app.study.made import PLAN, good, made


def test_sweep_is_error_as_a_share_of_the_target_speed():
    rows = [
        made(trial=1, n=8, metrics=good(6.0, 0.03)),
        made(trial=2, n=8, metrics=good(6.0, 0.06)),
        made(trial=1, n=10),
        made(speed=0.15, n=8, metrics=good(6.0, 0.03)),
    ]
    table = sweep_table(replace(PLAN, methods=("paper",)), rows)
    assert table is not None
    by_n = {row["n"]: row for row in table.rows}
    assert list(by_n) == [1, 8, 10]
    assert by_n[8]["error_percent_0.30"] == pytest.approx(15.0)
    assert by_n[8]["error_percent_0.15"] == pytest.approx(20.0)
    assert by_n[8]["trials_0.30"] == "2/2"
    assert by_n[10]["error_percent_0.30"] is None
    assert (by_n[10]["coverage_0.30"], by_n[10]["trials_0.30"]) == (0.0, "0/1")
    assert [title for title, _ in table.groups] == ["", "", "0.15 m/s", "0.30 m/s"]


def test_without_recordings_of_the_swept_scenario_there_is_no_sweep():
    assert sweep_table(PLAN, [made("sideways", metrics=good(1.0, 0.1))]) is None
    assert sweep_table(replace(PLAN, sweep=()), [made(metrics=good(1.0, 0.1))]) is None


def test_metrics_are_all_that_evaluate_knows_and_sums_where_they_count():
    rows = [made(trial=trial, metrics=good(6.0, 0.03)) for trial in (1, 2)]
    table = metrics_table(replace(PLAN, methods=("paper",)), rows)
    (line,) = table.rows
    assert set(line) == {"experiment", "speed", *METRIC_INFO} - {"angle_deg", "velocity_error"}
    assert (line["pairs"], line["points_with_flow"]) == (14, 200)
    assert line["epe3d"] == pytest.approx(0.01)
    assert line["dynamic_iou"] is None
    assert "displacements than the 0.16 m of these pairs" in table.note
    for name in line.keys() & METRIC_INFO.keys():
        info = METRIC_INFO[name]
        assert (info.described in table.note) == (info.kind != "count")
    assert ERROR_SYMBOLS in table.note
    slower = [*rows, made(speed=0.15, metrics=good(6.0, 0.03))]
    assert "the 0.08 to 0.16 m of these" in metrics_table(PLAN, slower).note
    assert "of these pairs" not in metrics_table(PLAN, [made("still", 0.0)]).note


def test_where_the_truth_is_a_frames_motion_the_notes_say_what_that_means():
    given = (Recorded(Path("a.mcap"), truth_frame="panel"),)
    rows = [made(metrics=good(6.0, 0.03))]
    for make in (metrics_table, recordings_table, lambda *of: paper_tables(*of)[0]):
        assert "precision is 1 by construction" in make(replace(PLAN, recordings=given), rows).note
        assert "by construction" not in make(PLAN, rows).note


def test_scenarios_beyond_the_papers_have_a_table_of_their_own():
    still = {"false_flow": 0.25, "pairs": 0, "coverage": None}
    rows = [
        made(metrics=good(6.0, 0.03)),
        made("crossing", 0.5, 1, metrics=good(10.0, 0.1)),
        made("crossing", 0.5, 2, metrics=good(20.0, 0.3)),
        made("still", 0.0, 1, metrics=still),
    ]
    table = scenarios_table(replace(PLAN, methods=("paper",)), rows)
    assert table is not None
    crossing, rests = table.rows
    assert (crossing["angle_deg"], crossing["trials"]) == (15.0, 2)
    assert crossing["velocity_error"] == pytest.approx(0.2)
    assert (rests["experiment"], rests["speed"]) == ("still (Algorithm 1)", 0.0)
    assert (rests["false_flow"], rests["angle_deg"], rests["coverage"]) == (0.25, None, None)
    assert scenarios_table(PLAN, rows[:1]) is None


def test_ablation_has_a_line_per_noise_model_imperfection_and_method():
    plan = replace(PLAN, ablation=True)
    rows = [
        made(speed=0.15, noise="paper", metrics=good(6.0, 0.03)),
        made(speed=0.15, noise="none", metrics=good(3.0, 0.01)),
        made(speed=0.15, imperfections=("bias",), metrics=good(9.0, 0.05)),
    ]
    table = ablation_table(plan, rows)
    assert table is not None
    assert len(table.rows) == 2 * (len(NOISE_MODELS) + len(IMPERFECTIONS))
    angles = {
        (row["noise"], row["imperfection"]): row["angle_deg"]
        for row in table.rows
        if row["method"] == "paper"
    }
    assert angles["paper", "none"] == 6.0
    assert angles["none", "none"] == 3.0
    assert angles["paper", "bias"] == 9.0
    assert ablation_table(PLAN, rows) is None


def test_recordings_have_a_line_each_per_method():
    rows = [
        made(metrics=good(6.0, 0.03)),
        made(method="baseline", metrics=good(80.0, 0.2)),
        made(n=10, metrics=good(5.0, 0.02)),
    ]
    table = recordings_table(PLAN, rows)
    assert [(row["recording"], row["method"], row["angle_deg"]) for row in table.rows] == [
        ("towards_0.3_1", "paper", 6.0),
        ("towards_0.3_1", "baseline", 80.0),
    ]
