import numpy as np
import pytest

from recordings.simulation.scenario import SCENARIOS, SPEEDS, TRIALS


def test_the_paths_are_the_papers():
    assert list(SCENARIOS) == ["towards", "sideways", "robot_moving"]
    towards, sideways, moving = SCENARIOS.values()
    assert towards.mannequin_glide(0.2).displacement(9.0) == pytest.approx([0.0, -0.30, 0.0])
    assert sideways.mannequin_glide(0.2).displacement(9.0) == pytest.approx([0.25, 0.0, 0.0])
    assert moving.mannequin == towards.mannequin
    assert towards.robot_glide() is None
    assert sideways.robot_glide() is None


def test_the_arm_draws_back_by_the_papers_two_pieces_in_one_direction():
    glide = SCENARIOS["robot_moving"].robot_glide()
    assert glide is not None
    first, second = glide.pieces
    assert first == pytest.approx([0.05, -0.15, 0.0])
    assert np.linalg.norm(second) == pytest.approx(0.10)
    assert np.cross(first, second) == pytest.approx(np.zeros(3), abs=1e-12)
    assert first @ second > 0
    assert glide.speed == 0.25


def test_speeds_and_trials_are_the_papers():
    assert SPEEDS == (0.15, 0.20, 0.25, 0.30)
    assert len(TRIALS) == 5
