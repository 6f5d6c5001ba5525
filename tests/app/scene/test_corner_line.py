from dataclasses import replace

import pytest

from app.analysis.comparison import A, B
from app.analysis.estimates import Estimates
from app.scene.corner_line import corner_line, corner_parts, parameters_text
from estimator import Parameters
from tests.app.fake_recordings import fake_opened, fake_recording


@pytest.fixture(scope="module")
def pair():
    return Estimates().estimated(fake_opened(), 24, Parameters())


def test_the_line_says_what_is_drawn(pair):
    recording = fake_recording(name="walk")
    assert corner_line(recording, 24, pair, Parameters()) == (
        "walk · frame 24 of 39 · 1.60 s · Δt 0.533 s · paper · n 8, γ 0.7, δ 0.04 m, N_min 60"
    )


def test_simulated_recordings_are_called_simulated():
    recording = fake_recording(name="walk")
    recording.simulated = True
    assert corner_parts(recording, 0, None, Parameters())[0] == "walk (simulated)"


def test_without_a_pair_there_is_no_interval(pair):
    assert "Δt" not in corner_line(fake_recording(), 24, None, Parameters())
    early = replace(pair, source=None, interval=float("nan"))
    assert "Δt" not in corner_line(fake_recording(), 24, early, Parameters())


def test_parameters_without_a_slider_are_named_where_they_differ_from_their_defaults():
    other = Parameters(min_cluster_size=30, allow_single_cluster=True, max_range=2.5)
    assert parameters_text(other) == (
        "n 8, γ 0.7, δ 0.04 m, N_min 60, min cluster size 30, allow single cluster, max range 2.5 m"
    )


def test_only_parameters_of_the_method_are_named():
    assert parameters_text(Parameters(method="baseline", gamma=0.1)) == "n 8, N_min 60"


def test_both_sides_are_named_where_both_are_drawn(pair):
    sides = {A: Parameters(), B: Parameters(method="baseline")}
    parts = corner_parts(fake_recording(), 24, pair, Parameters(), sides)
    assert parts[-2:] == ("A: paper n 8, γ 0.7, δ 0.04 m, N_min 60", "B: baseline n 8, N_min 60")


def test_the_middle_of_a_long_name_is_left_out():
    name, *_ = corner_parts(fake_recording(name="a" * 100 + "_25_1"), 0, None, Parameters())
    assert len(name) <= 60
    assert name.startswith("aaa")
    assert name.endswith("_25_1")
