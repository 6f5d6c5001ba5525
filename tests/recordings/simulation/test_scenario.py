import numpy as np
import pytest

from recordings.simulation.scenario import PAPER_SCENARIOS, SCENARIOS, SPEEDS, TRIALS


def test_the_paths_are_the_papers():
    towards, sideways, moving = (SCENARIOS[name] for name in PAPER_SCENARIOS)
    assert np.array(towards.mannequin) == pytest.approx(np.array([[0.0, -0.30, 0.0]]))
    assert np.array(sideways.mannequin) == pytest.approx(np.array([[0.25, 0.0, 0.0]]))
    assert moving.mannequin == towards.mannequin
    assert towards.robot_trajectory() is None
    assert sideways.robot_trajectory() is None


def test_the_arm_draws_back_by_the_papers_two_segments_in_one_direction():
    trajectory = SCENARIOS["robot_moving"].robot_trajectory()
    assert trajectory is not None
    first, second = trajectory.segments
    assert first == pytest.approx([0.05, -0.15, 0.0])
    assert np.linalg.norm(second) == pytest.approx(0.10)
    assert np.cross(first, second) == pytest.approx(np.zeros(3), abs=1e-12)
    assert first @ second > 0
    assert trajectory.speed == 0.25


def test_speeds_and_trials_are_the_papers():
    assert SPEEDS == (0.15, 0.20, 0.25, 0.30)
    assert len(TRIALS) == 5
    assert all(SCENARIOS[name].speeds == SPEEDS for name in PAPER_SCENARIOS)


def test_a_person_walks_at_three_speeds_and_something_flies_at_2_m_s():
    assert len(SCENARIOS["walking"].speeds) == 3
    assert max(SCENARIOS["fast"].speeds) == 2.0


def test_nothing_moves_where_the_speed_is_0():
    still = [name for name, scenario in SCENARIOS.items() if scenario.still]
    assert still == ["still", "still_robot_moving"]
    assert [SCENARIOS[name].robot_trajectory() is not None for name in still] == [False, True]
    assert all(SCENARIOS[name].speeds == (0.0,) for name in still)
