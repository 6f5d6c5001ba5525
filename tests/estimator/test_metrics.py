import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from estimator import Label, PooledErrors, SceneFlow, angles_deg


def flow(velocity: np.ndarray) -> SceneFlow:
    """A flow of points; rows of NaN are stationary."""
    label = np.where(np.isfinite(velocity).all(axis=1), Label.MOVING, Label.STATIONARY)
    return SceneFlow(label.astype(np.int64), velocity, np.zeros(len(velocity), np.int64), ())


NONE = [np.nan, np.nan, np.nan]


def test_errors_of_a_case_worked_by_hand():
    errors = PooledErrors()
    truth = np.tile([0.0, -0.2, 0.0], (4, 1))
    points = np.array([[0, -0.2, 0], [0, -0.2, 0], [0, 0, 0], [0, 0, 0]])
    errors.add(flow(np.array([[0, -0.2, 0], NONE, [0.2, 0, 0], NONE])), 0.5, truth, points)
    metrics = errors.metrics()
    assert metrics.pairs == 1
    assert metrics.points_with_flow == 2
    assert metrics.angle_deg == pytest.approx(45.0)
    assert metrics.velocity_error == pytest.approx(0.2 * np.sqrt(2) / 2)
    assert metrics.coverage == 0.5
    assert metrics.precision == 0.5
    assert metrics.epe3d == pytest.approx((0 + 0.1 + 0.1 + 0) / 4)


def test_points_are_pooled_over_pairs_and_not_averaged_pair_by_pair():
    errors = PooledErrors()
    east, north = np.array([1.0, 0, 0]), np.array([0, 1.0, 0])
    errors.add(flow(np.tile(east, (3, 1))), 1.0, np.tile(east, (3, 1)), None)
    errors.add(flow(np.tile(north, (1, 1))), 1.0, np.tile(east, (1, 1)), None)
    assert errors.metrics().angle_deg == pytest.approx(90 / 4)
    assert np.isnan(errors.metrics().coverage)


def test_a_pair_without_flow_counts_and_nothing_is_defined_by_nothing():
    errors = PooledErrors()
    errors.add(flow(np.array([NONE])), 1.0, np.ones((1, 3)), np.zeros((1, 3)))
    metrics = errors.metrics()
    assert metrics.pairs == 1
    assert metrics.points_with_flow == 0
    assert np.isnan([metrics.angle_deg, metrics.velocity_error, metrics.precision]).all()
    assert np.isnan(metrics.coverage)
    assert metrics.epe3d == 0.0


def test_points_of_unknown_truth_enter_only_the_papers_errors():
    errors = PooledErrors()
    velocity = np.array([[1.0, 0, 0], [1.0, 0, 0]])
    points = np.array([[1.0, 0, 0], NONE])
    errors.add(flow(velocity), 1.0, np.ones((2, 3)), points)
    metrics = errors.metrics()
    assert metrics.points_with_flow == 2
    assert metrics.precision == metrics.coverage == 1.0
    assert metrics.epe3d == 0.0


def test_a_flow_of_zero_has_no_angle():
    errors = PooledErrors()
    errors.add(flow(np.zeros((1, 3))), 1.0, np.ones((1, 3)), None)
    assert np.isnan(errors.metrics().angle_deg)
    assert errors.metrics().velocity_error == pytest.approx(np.sqrt(3))


@given(st.floats(0, np.pi), st.floats(1e-3, 1e3), st.floats(1e-3, 1e3))
def test_angles_do_not_depend_on_lengths(angle: float, a: float, b: float):
    u = np.array([[a, 0.0, 0.0]])
    v = b * np.array([[np.cos(angle), np.sin(angle), 0.0]])
    assert angles_deg(u, v)[0] == pytest.approx(np.degrees(angle), abs=1e-6)


def test_pairs_collected_apart_are_the_same_to_the_last_bit():
    generator = np.random.default_rng(3)
    together, apart = PooledErrors(), PooledErrors()
    for size in (5, 0, 31, 200):
        label = generator.integers(0, 3, size)
        velocity = generator.normal(size=(size, 3))
        velocity[label != Label.MOVING] = np.nan
        found = SceneFlow(label, velocity, np.zeros(size, dtype=np.int64), ())
        truth = generator.normal(size=(size, 3))
        points = generator.normal(size=(size, 3)) * generator.integers(0, 2, (size, 1))
        one = PooledErrors()
        for errors in (together, one):
            errors.add(found, 0.5, truth, points)
        apart.include(one.sums)
    assert apart.metrics() == together.metrics()
    assert apart.metrics().pairs == 4
    assert apart.metrics().points_with_flow > 50
