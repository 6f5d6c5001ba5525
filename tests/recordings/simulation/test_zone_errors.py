import numpy as np
import pytest

from recordings.simulation.zone_errors import Bias, FixedPattern, border_factors, corners

SHAPE = (2_000, 8, 8)


def test_four_zones_are_corners():
    assert corners((8, 8)).sum() == 4
    assert corners((8, 8))[[0, 0, 7, 7], [0, 7, 0, 7]].all()


def test_noise_grows_at_the_border_and_more_at_the_corners():
    factors = border_factors(SHAPE, np.random.default_rng(0))
    assert (factors[:, 1:-1, 1:-1] == 1.0).all()
    corner = factors[:, corners((8, 8))]
    assert (corner.min(), corner.max()) == pytest.approx((1.33, 1.47), abs=1e-3)
    border = factors[:, 0, 1:-1]
    assert (border.min(), border.max()) == pytest.approx((1.15, 1.20), abs=1e-3)


def test_a_fixed_pattern_is_a_constant_of_each_zone():
    pattern = FixedPattern(SHAPE, np.random.default_rng(0))
    error = pattern.error(np.full(SHAPE, 1.0))
    assert np.array_equal(error, pattern.error(np.full(SHAPE, 3.0)))
    assert error[:, 1:-1, 1:-1].std() == pytest.approx(0.001, rel=0.02)
    assert error[:, corners((8, 8))].std() == pytest.approx(0.003, rel=0.05)


def test_the_bias_of_a_sensor_is_a_line_over_the_distance_and_the_same_in_all_its_zones():
    bias = Bias((5_000, 8, 8), np.random.default_rng(1))
    at_0, at_1, at_2 = (bias.error(np.full((5_000, 8, 8), d)) for d in (0.0, 1.0, 2.0))
    assert at_2 - at_1 == pytest.approx(at_1 - at_0)
    assert np.ptp(at_1, axis=(1, 2)) == pytest.approx(np.zeros(5_000))
    assert at_0[:, 0, 0].std() == pytest.approx(0.010, rel=0.05)
    assert (at_1 - at_0)[:, 0, 0].std() == pytest.approx(0.01, rel=0.05)
