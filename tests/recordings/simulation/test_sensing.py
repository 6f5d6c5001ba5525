from collections.abc import Collection

import numpy as np
import pytest

from recordings.simulation.edges import ZoneHits
from recordings.simulation.imperfections import Streams
from recordings.simulation.noise import NOISE_MODELS
from recordings.simulation.sensing import Report, Sensing
from recordings.simulation.surface import Surface
from robot_assets import SensorModel

SENSORS = 300
WHITE, GREY, WOOD = Surface(0.88), Surface(0.17), Surface(0.88, drops_out=True)


def sensing(noise: str, imperfections: Collection[str] = ()) -> Sensing:
    rng = np.random.default_rng(0)
    return Sensing(SENSORS, SensorModel(), NOISE_MODELS[noise], imperfections, rng, Streams([0]))


def report(
    noise: str,
    distance: float,
    surface: Surface = WHITE,
    imperfections: Collection[str] = (),
) -> Report:
    shape = (SENSORS, 8, 8)
    seen = ZoneHits(np.full(shape, distance), np.zeros(shape, dtype=np.int64))
    return sensing(noise, imperfections).report(seen, None, {0: surface})


def test_readings_outside_the_range_are_not_reported():
    for distance, reported in [(0.01, False), (0.02, True), (4.0, True), (4.01, False)]:
        assert (np.isfinite(report("none", distance).ranges) == reported).all()
    noisy = report("paper", 4.0).ranges
    assert 0.4 < np.isnan(noisy).mean() < 0.6
    assert np.nanmax(noisy) <= 4.0


def test_nothing_is_reported_where_nothing_is_met():
    found = report("paper", np.inf)
    assert np.isnan(found.ranges).all()
    assert not found.valid.any()


def test_the_papers_noise_is_gaussian():
    relative = report("paper", 1.0).ranges - 1.0
    # The variance of a Gaussian whose sigma is uniform from a to b is (a² + a b + b²) / 3.
    a, b = 0.08 / 3, 0.11 / 3
    assert relative.std() == pytest.approx(np.sqrt((a * a + a * b + b * b) / 3), rel=0.02)
    assert relative.mean() == pytest.approx(0.0, abs=1e-3)
    assert 0.001 < (np.abs(relative) > 0.095).mean() < 0.006


def test_without_a_model_of_validity_there_is_no_status():
    assert report("paper", 1.0).status is None
    assert report("none", 1.0, imperfections=["bias", "border_zones"]).status is None


def test_beyond_its_reach_a_reading_has_a_status_and_still_a_distance():
    found = report("datasheet", 1.2, GREY)
    assert found.status is not None
    corner = np.zeros((8, 8), dtype=bool)
    corner[np.ix_([0, -1], [0, -1])] = True
    assert (found.status[:, ~corner] == 5).all()
    assert (found.status[:, corner] == 255).all()
    assert np.array_equal(found.valid, found.status == 5)
    error = np.abs(found.ranges - 1.2)[:, corner]
    assert np.isfinite(error).all()
    # Five sigma; the rest of the readings that are not valid are off by 60 mm and more.
    assert (error < 5 * 0.05 * 1.2 / 2.7).mean() == pytest.approx(0.91, abs=0.04)


def test_measured_readings_of_wood_drop_out_and_others_do_not():
    assert report("measured", 1.0, WOOD).valid.mean() == pytest.approx(0.4, abs=0.03)
    assert report("measured", 1.0, WHITE).valid.mean() == pytest.approx(0.999, abs=0.001)
    assert report("paper", 1.0, WOOD, ["dropouts"]).valid.mean() == pytest.approx(0.4, abs=0.03)


def test_measured_noise_is_that_of_its_parts():
    found = report("measured", 1.0)
    error = np.where(found.valid, found.ranges - 0.995, np.nan)
    inner, corner = error[:, 1:-1, 1:-1], error[:, 0, 0]
    assert np.nanstd(inner) == pytest.approx(np.hypot(0.0065, 0.001), rel=0.03)
    assert np.nanmean(inner) == pytest.approx(0.0, abs=1e-3)
    assert np.nanstd(corner) == pytest.approx(np.hypot(1.4 * 0.0065, 0.003), rel=0.1)


def test_one_imperfection_does_not_change_the_numbers_of_another_or_of_the_noise():
    plain = report("paper", 1.0, WOOD).ranges
    biased = report("paper", 1.0, WOOD, ["bias"]).ranges
    dropping = report("paper", 1.0, WOOD, ["dropouts"])
    both = report("paper", 1.0, WOOD, ["bias", "dropouts"])
    assert np.array_equal(dropping.valid, both.valid)
    assert dropping.ranges[dropping.valid] == pytest.approx(plain[dropping.valid], abs=1e-12)
    assert both.ranges[both.valid] == pytest.approx(biased[both.valid], abs=1e-12)
