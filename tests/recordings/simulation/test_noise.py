import numpy as np
import pytest

from recordings.simulation.imperfections import IMPERFECTIONS
from recordings.simulation.noise import NOISE_MODELS, NoiseModel


def sigmas(model: NoiseModel, distance: float, reflectance: float = 0.5) -> np.ndarray:
    readings = np.full(200_000, distance)
    return model.sigma(readings, np.full(200_000, reflectance), np.random.default_rng(3))


@pytest.mark.parametrize("distance", [0.25, 1.0, 3.5])
def test_the_papers_noise_is_a_share_of_the_distance(distance: float):
    three = 3 * sigmas(NOISE_MODELS["paper"], distance) / distance
    assert (three.min(), three.max()) == pytest.approx((0.08, 0.11), abs=1e-4)
    assert three.mean() == pytest.approx(0.095, rel=1e-3)


@pytest.mark.parametrize("name", ["paper", "datasheet", "datasheet_bright"])
def test_below_a_fifth_of_a_metre_it_is_15_mm_at_2_7_sigma(name: str):
    for distance in (0.05, 0.19):
        assert sigmas(NOISE_MODELS[name], distance) == pytest.approx(0.015 / 2.7)


@pytest.mark.parametrize(
    ("name", "reflectance", "share"),
    [
        ("datasheet", 0.88, 0.05),
        ("datasheet", 0.17, 0.05),
        ("datasheet_bright", 0.88, 0.08),
        ("datasheet_bright", 0.17, 0.11),
    ],
)
def test_the_datasheets_accuracy_is_at_2_7_sigma(name: str, reflectance: float, share: float):
    assert sigmas(NOISE_MODELS[name], 2.0, reflectance) == pytest.approx(share * 2.0 / 2.7)


@pytest.mark.parametrize(
    ("name", "reflectance", "inner", "corner"),
    [
        ("datasheet", 0.88, 3.5, 3.1),
        ("datasheet", 0.17, 1.3, 1.1),
        ("datasheet_bright", 0.88, 1.1, 1.0),
        ("datasheet_bright", 0.17, 0.8, 0.65),
    ],
)
def test_the_datasheets_range_depends_on_the_surface_and_the_light(
    name: str, reflectance: float, inner: float, corner: float
):
    at = np.array([False, True])
    reach = NOISE_MODELS[name].reach(np.ones(2), np.full(2, reflectance), at)
    assert reach == pytest.approx([inner, corner])


def test_between_the_datasheets_surfaces_the_range_grows_with_the_reflectance():
    reflectance = np.linspace(0.1, 0.9, 30)
    reach = NOISE_MODELS["datasheet"].reach(np.ones(30), reflectance, np.zeros(30, dtype=bool))
    assert (np.diff(reach) > 0).all()


@pytest.mark.parametrize(
    ("distance", "millimetres"), [(0.025, 0.65), (0.92, 5.8), (2.16, 14.9), (3.44, 18.2)]
)
def test_measured_noise_is_near_what_was_measured(distance: float, millimetres: float):
    sigma = 1000 * sigmas(NOISE_MODELS["measured"], distance)[0]
    assert sigma == pytest.approx(millimetres, rel=0.2)


def test_measured_readings_are_short_by_half_a_percent_and_near_ones_long():
    shift = NOISE_MODELS["measured"].shift(np.array([0.2, 1.0, 3.0]))
    assert shift == pytest.approx([0.005, -0.005, -0.015])


def test_without_noise_readings_are_exact():
    model = NOISE_MODELS["none"]
    assert not sigmas(model, 1.0).any()
    assert not model.shift(np.ones(3)).any()
    assert model.includes == ()


def test_models_have_a_name_a_text_of_one_line_and_known_parts():
    for name, model in NOISE_MODELS.items():
        assert model.name == name
        assert model.text
        assert "\n" not in model.text
        assert set(model.includes) <= set(IMPERFECTIONS)
