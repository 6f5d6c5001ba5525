import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from recordings.simulation.trajectory import REST, Trajectory

BENT = np.array([[0.3, 0.0, 0.0], [0.0, -0.4, 0.0]])


def test_it_rests_then_keeps_its_speed_then_rests():
    trajectory = Trajectory(np.array([[0.0, -0.3, 0.0]]), 0.15)
    assert trajectory.end == pytest.approx(REST + 2.0)
    for time, velocity, travelled in [
        (0.0, 0.0, 0.0),
        (REST - 0.01, 0.0, 0.0),
        (REST + 0.01, -0.15, 0.0015),
        (REST + 1.0, -0.15, 0.15),
        (REST + 1.99, -0.15, 0.2985),
        (REST + 2.01, 0.0, 0.3),
        (100.0, 0.0, 0.3),
    ]:
        assert trajectory.velocity(time) == pytest.approx([0.0, velocity, 0.0])
        assert trajectory.travelled(time) == pytest.approx(travelled)
        assert trajectory.displacement(travelled) == pytest.approx([0.0, -travelled, 0.0])


def test_segments_follow_each_other():
    trajectory = Trajectory(BENT, 0.1)
    assert trajectory.length == pytest.approx(0.7)
    assert trajectory.displacement(0.3) == pytest.approx([0.3, 0.0, 0.0])
    assert trajectory.displacement(0.5) == pytest.approx([0.3, -0.2, 0.0])
    assert trajectory.displacement(0.7) == pytest.approx([0.3, -0.4, 0.0])
    assert trajectory.velocity(REST + 2.9) == pytest.approx([0.1, 0.0, 0.0])
    assert trajectory.velocity(REST + 3.1) == pytest.approx([0.0, -0.1, 0.0])


@given(st.floats(0.05, 1.0), st.floats(0.0, 1.0))
def test_velocity_is_the_derivative_of_the_displacement(speed: float, share: float):
    trajectory, step = Trajectory(BENT, speed), 1e-6
    time = REST + share * trajectory.length / speed
    corner = REST + 0.3 / speed
    if min(abs(time - t) for t in (REST, corner, trajectory.end)) < 2 * step:
        return
    after, before = (trajectory.displacement(trajectory.travelled(time + s)) for s in (step, -step))
    assert (after - before) / (2 * step) == pytest.approx(trajectory.velocity(time), abs=1e-6)


@pytest.mark.parametrize("speed", [0.0, -0.1, float("nan")])
def test_a_speed_that_is_not_above_zero_is_refused(speed: float):
    with pytest.raises(ValueError, match="above 0 m/s"):
        Trajectory(BENT, speed)


@given(st.floats(0.05, 2.0), st.floats(0.05, 1.0), st.floats(0.0, 1.0))
def test_a_ramp_covers_the_same_path_without_jumps(speed: float, ramp: float, share: float):
    trajectory = Trajectory(BENT, speed, ramp)
    times = np.linspace(REST, trajectory.end, 2001)
    speeds = [trajectory.speed_at(time) for time in times]
    assert np.trapezoid(speeds, times) == pytest.approx(0.7, rel=1e-4)
    assert trajectory.travelled(trajectory.end) == pytest.approx(0.7)
    assert max(speeds) <= speed * (1 + 1e-9)
    assert np.abs(np.diff(speeds)).max() <= speed / ramp * (times[1] - times[0]) * (1 + 1e-6)
    time = REST + share * (trajectory.end - REST)
    rate = (trajectory.travelled(time + 1e-6) - trajectory.travelled(time - 1e-6)) / 2e-6
    assert rate == pytest.approx(trajectory.speed_at(time), abs=1e-5 * (1 + speed / ramp))


def test_a_ramp_takes_its_time_where_the_path_has_room():
    trajectory = Trajectory(BENT, 0.7, 0.25)
    assert trajectory.end == pytest.approx(REST + 1.25)
    assert trajectory.speed_at(REST + 0.125) == pytest.approx(0.35)
    assert trajectory.travelled(REST + 0.25) == pytest.approx(0.0875)
    assert trajectory.velocity(REST + 0.25) == pytest.approx([0.7, 0.0, 0.0])
    assert trajectory.velocity(trajectory.end - 0.125) == pytest.approx([0.0, -0.35, 0.0])


def test_on_a_short_path_the_acceleration_is_kept_and_the_speed_is_not_reached():
    trajectory = Trajectory(np.array([[0.08, 0.0, 0.0]]), 1.0, 0.5)
    assert trajectory.end == pytest.approx(REST + 0.4)
    assert trajectory.speed_at(REST + 0.2) == pytest.approx(0.4)
    assert trajectory.travelled(REST + 0.2) == pytest.approx(0.04)
