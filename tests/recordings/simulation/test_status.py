import numpy as np
import pytest

from recordings.simulation.edges import Edges, ZoneHits
from recordings.simulation.status import VALID, Dropouts, FlyingPixels, invalid_codes

SHAPE = (400, 8, 8)


def test_codes_are_as_frequent_as_they_were_seen():
    codes = invalid_codes((100_000,), np.random.default_rng(0))
    shares = [(codes == code).mean() for code in (255, 4, 2)]
    assert shares == pytest.approx([37 / 40.8, 3 / 40.8, 0.8 / 40.8], abs=0.005)
    assert sum(shares) == pytest.approx(1.0)


def test_readings_of_surfaces_that_drop_out_stay_out():
    dropouts = Dropouts(np.random.default_rng(0))
    wood = np.ones(SHAPE, dtype=bool)
    valid = np.stack([dropouts.next(wood) == VALID for _ in range(12)])
    before, after = valid[:-1], valid[1:]
    assert after[before].mean() == pytest.approx(0.943, abs=0.003)
    assert after[~before].mean() == pytest.approx(0.038, abs=0.003)
    # Validity is in balance from the first frame on.
    assert valid.mean(axis=(1, 2, 3)) == pytest.approx(np.full(12, 0.4), abs=0.02)


def test_readings_of_other_surfaces_hardly_ever_drop_out():
    dropouts = Dropouts(np.random.default_rng(0))
    other = np.zeros(SHAPE, dtype=bool)
    valid = np.stack([dropouts.next(other) == VALID for _ in range(12)])
    assert valid.mean() == pytest.approx(0.999, abs=0.0005)


def test_a_zone_that_comes_to_see_another_surface_is_valid_again():
    dropouts = Dropouts(np.random.default_rng(0))
    assert (dropouts.next(np.ones(SHAPE, dtype=bool)) == VALID).mean() < 0.5
    assert (dropouts.next(np.zeros(SHAPE, dtype=bool)) == VALID).mean() > 0.99


def test_what_zones_across_a_step_read():
    step = np.zeros(SHAPE, dtype=bool)
    step[:, :, 4] = True
    ones = np.ones(SHAPE, dtype=np.int64)
    seen = ZoneHits(np.full(SHAPE, 1.0), ones)
    edges = Edges(
        step, ZoneHits(np.full(SHAPE, 0.9), ones), ZoneHits(np.full(SHAPE, 2.0), 2 * ones)
    )
    read, status = FlyingPixels(np.random.default_rng(0)).next(seen, edges)
    assert (status[~step] == VALID).all()
    assert (read.distance[~step] == 1.0).all()
    assert (status[step] == VALID).mean() == pytest.approx(0.64, abs=0.02)
    distance, piece = read.distance[step], read.piece[step]
    shares = [(distance == 0.9).mean(), (distance == 2.0).mean(), (distance == 1.0).mean()]
    assert shares == pytest.approx([0.39, 0.41, 0.05], abs=0.02)
    between = (distance > 0.9) & (distance < 2.0) & (distance != 1.0)
    assert between.mean() == pytest.approx(0.15, abs=0.02)
    # It is taken to be of what it is nearer to.
    assert np.array_equal(piece == 2, distance > 1.45)
