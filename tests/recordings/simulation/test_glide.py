import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from recordings.simulation.glide import REST, Glide

BENT = np.array([[0.3, 0.0, 0.0], [0.0, -0.4, 0.0]])


def test_it_rests_then_keeps_its_speed_then_rests():
    glide = Glide(np.array([[0.0, -0.3, 0.0]]), 0.15)
    assert glide.end == pytest.approx(REST + 2.0)
    for time, velocity, travelled in [
        (0.0, 0.0, 0.0),
        (REST - 0.01, 0.0, 0.0),
        (REST + 0.01, -0.15, 0.0015),
        (REST + 1.0, -0.15, 0.15),
        (REST + 1.99, -0.15, 0.2985),
        (REST + 2.01, 0.0, 0.3),
        (100.0, 0.0, 0.3),
    ]:
        assert glide.velocity(time) == pytest.approx([0.0, velocity, 0.0])
        assert glide.travelled(time) == pytest.approx(travelled)
        assert glide.displacement(travelled) == pytest.approx([0.0, -travelled, 0.0])


def test_pieces_follow_each_other():
    glide = Glide(BENT, 0.1)
    assert glide.length == pytest.approx(0.7)
    assert glide.displacement(0.3) == pytest.approx([0.3, 0.0, 0.0])
    assert glide.displacement(0.5) == pytest.approx([0.3, -0.2, 0.0])
    assert glide.displacement(0.7) == pytest.approx([0.3, -0.4, 0.0])
    assert glide.velocity(REST + 2.9) == pytest.approx([0.1, 0.0, 0.0])
    assert glide.velocity(REST + 3.1) == pytest.approx([0.0, -0.1, 0.0])


@given(st.floats(0.05, 1.0), st.floats(0.0, 1.0))
def test_velocity_is_the_derivative_of_the_displacement(speed: float, share: float):
    glide, step = Glide(BENT, speed), 1e-6
    time = REST + share * glide.length / speed
    corner = REST + 0.3 / speed
    if min(abs(time - t) for t in (REST, corner, glide.end)) < 2 * step:
        return
    after, before = (glide.displacement(glide.travelled(time + s)) for s in (step, -step))
    assert (after - before) / (2 * step) == pytest.approx(glide.velocity(time), abs=1e-6)


@pytest.mark.parametrize("speed", [0.0, -0.1, float("nan")])
def test_a_speed_that_is_not_above_zero_is_refused(speed: float):
    with pytest.raises(ValueError, match="above 0 m/s"):
        Glide(BENT, speed)


@given(st.floats(0.05, 2.0), st.floats(0.05, 1.0), st.floats(0.0, 1.0))
def test_a_ramp_covers_the_same_path_without_jumps(speed: float, ramp: float, share: float):
    glide = Glide(BENT, speed, ramp)
    times = np.linspace(REST, glide.end, 2001)
    speeds = [glide.speed_at(time) for time in times]
    assert np.trapezoid(speeds, times) == pytest.approx(0.7, rel=1e-4)
    assert glide.travelled(glide.end) == pytest.approx(0.7)
    assert max(speeds) <= speed * (1 + 1e-9)
    assert np.abs(np.diff(speeds)).max() <= speed / ramp * (times[1] - times[0]) * (1 + 1e-6)
    time = REST + share * (glide.end - REST)
    rate = (glide.travelled(time + 1e-6) - glide.travelled(time - 1e-6)) / 2e-6
    assert rate == pytest.approx(glide.speed_at(time), abs=1e-5 * (1 + speed / ramp))


def test_a_ramp_takes_its_time_where_the_path_has_room():
    glide = Glide(BENT, 0.7, 0.25)
    assert glide.end == pytest.approx(REST + 1.25)
    assert glide.speed_at(REST + 0.125) == pytest.approx(0.35)
    assert glide.travelled(REST + 0.25) == pytest.approx(0.0875)
    assert glide.velocity(REST + 0.25) == pytest.approx([0.7, 0.0, 0.0])
    assert glide.velocity(glide.end - 0.125) == pytest.approx([0.0, -0.35, 0.0])


def test_on_a_short_path_the_acceleration_is_kept_and_the_speed_is_not_reached():
    glide = Glide(np.array([[0.08, 0.0, 0.0]]), 1.0, 0.5)
    assert glide.end == pytest.approx(REST + 0.4)
    assert glide.speed_at(REST + 0.2) == pytest.approx(0.4)
    assert glide.travelled(REST + 0.2) == pytest.approx(0.04)
