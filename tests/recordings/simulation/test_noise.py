import numpy as np
import pytest

from recordings.simulation.noise import NOISE_MODELS


def errors(name: str, distance: float, count: int = 200_000) -> np.ndarray:
    readings = np.full(count, distance)
    return NOISE_MODELS[name].sample(readings, np.random.default_rng(3)) - readings


@pytest.mark.parametrize("distance", [0.25, 1.0, 3.5])
def test_the_papers_noise_is_a_share_of_the_distance(distance: float):
    relative = errors("paper", distance) / distance
    # The variance of a Gaussian whose sigma is uniform from a to b is (a² + a b + b²) / 3.
    a, b = 0.08 / 3, 0.11 / 3
    assert relative.std() == pytest.approx(np.sqrt((a * a + a * b + b * b) / 3), rel=0.01)
    assert relative.mean() == pytest.approx(0.0, abs=5e-4)
    assert 0.001 < (np.abs(relative) > 0.095).mean() < 0.006


def test_below_a_fifth_of_a_metre_it_is_15_mm_at_2_7_sigma():
    assert errors("paper", 0.1).std() == pytest.approx(0.015 / 2.7, rel=0.01)
    assert errors("paper", 0.05).std() == pytest.approx(0.015 / 2.7, rel=0.01)


def test_without_noise_readings_are_exact():
    assert not errors("none", 1.0, 100).any()


def test_models_have_a_name_and_a_text_of_one_line():
    for name, model in NOISE_MODELS.items():
        assert model.name == name
        assert model.text
        assert "\n" not in model.text
