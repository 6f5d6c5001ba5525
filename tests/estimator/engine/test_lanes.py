"""Each vector instruction against NumPy."""

import numpy as np
import pytest

from estimator.engine import lanes
from estimator.engine.compiled import compiled

INF = np.inf


@compiled
def near(points, at, x, y, z, limit):
    return lanes.near(points, at, x, y, z, limit)


@compiled
def beyond(points, cores, at, x, y, z, core, limit):
    return lanes.beyond(points, cores, at, x, y, z, core, limit)


@compiled
def boxes_near(boxes, at, low, high, limit):
    return lanes.boxes_near(boxes, at, low[0], low[1], low[2], high[0], high[1], high[2], limit)


@compiled
def minimum_of_64(values, at):
    return lanes.minimum_of_64(values, at)


@compiled
def first_equal_of_64(values, at, wanted):
    return lanes.first_equal_of_64(values, at, wanted)


@compiled
def largest_below(values, at, bound):
    return lanes.largest_below(values, at, bound)


@compiled
def count_from(values, at, bound):
    return lanes.count_from(values, at, bound)


@compiled
def lowest_set(mask):
    return lanes.lowest_set(mask)


def mask_of(truths: np.ndarray) -> int:
    return sum(1 << lane for lane in np.flatnonzero(truths).tolist())


def squared(points: np.ndarray, query: np.ndarray) -> np.ndarray:
    x, y, z = points - query[:, None]
    return (x * x + y * y) + z * z


@pytest.fixture(params=range(30))
def rng(request) -> np.random.Generator:
    return np.random.default_rng(request.param)


def on_a_lattice(rng: np.random.Generator, *shape: int) -> np.ndarray:
    """Coordinates of which many are equal, so that limits are met exactly."""
    return rng.integers(-2, 3, shape) * 0.1


def test_near(rng):
    points, query = on_a_lattice(rng, 3, 24), on_a_lattice(rng, 3)
    points[:, 20:] = INF
    for limit in (0.0, *squared(points, query)[:5]):
        for at in (0, 8, 16):
            expected = mask_of(squared(points, query)[at : at + 8] <= limit)
            assert near(points, at, query[0], query[1], query[2], limit) == expected


def test_beyond(rng):
    points, query = on_a_lattice(rng, 3, 24), on_a_lattice(rng, 3)
    cores = rng.choice(squared(points, query), 24)
    distances = squared(points, query)
    for core, limit in rng.choice(distances, (5, 2)):
        for at in (0, 8, 16):
            outside = (distances <= limit) & (distances > core) & (distances > cores)
            found = beyond(points, cores, at, query[0], query[1], query[2], core, limit)
            assert found == mask_of(outside[at : at + 8])


def test_boxes_near(rng):
    corners = np.sort(on_a_lattice(rng, 2, 3, 17), axis=0)
    boxes = np.full((6, 24), INF)
    boxes[3:] = -INF
    boxes[:3, :17], boxes[3:, :17] = corners
    low, high = np.sort(on_a_lattice(rng, 2, 3), axis=0)
    gaps = np.maximum(np.maximum(boxes[:3] - high[:, None], low[:, None] - boxes[3:]), 0.0)
    distances = squared(gaps, np.zeros(3))
    for limit in (0.0, *distances[:5]):
        for at in (0, 8, 16):
            found = boxes_near(boxes, at, tuple(low), tuple(high), limit)
            assert found == mask_of(distances[at : at + 8] <= limit)
    assert boxes_near(boxes, 16, tuple(low), tuple(high), 1e300) == 1, "empty boxes are never near"


def test_minimum_of_64(rng):
    values = np.where(rng.uniform(size=192) < 0.5, INF, rng.integers(0, 9, 192) * 0.1)
    for at in (0, 64, 128):
        assert minimum_of_64(values, at) == values[at : at + 64].min()
    assert minimum_of_64(np.full(64, INF), 0) == INF


def test_first_equal_of_64(rng):
    values = rng.integers(0, 40, 192) * 0.1
    for at in (0, 64, 128):
        for wanted in (*values[at : at + 64 : 7], -1.0):
            equal = np.flatnonzero(values[at : at + 64] == wanted)
            expected = equal[0] if len(equal) else 64
            assert first_equal_of_64(values, at, wanted) == expected


@pytest.mark.parametrize("place", range(64))
def test_first_equal_of_64_at_every_place(place):
    values = np.zeros(64)
    values[place] = 1.0
    assert first_equal_of_64(values, 0, 1.0) == place


def test_largest_below_and_count_from(rng):
    values = rng.integers(0, 12, 96) * 0.1
    for at in (0, 32, 64):
        part = values[at : at + 32]
        for bound in (*part[:6], 0.0, INF):
            assert largest_below(values, at, bound) == max(part[part < bound], default=-1.0)
            assert count_from(values, at, bound) == (part >= bound).sum()


@pytest.mark.parametrize("mask", [1, 2, 3, 0b10100000, 128, 255, 1 << 40])
def test_lowest_set(mask):
    assert lowest_set(mask) == (mask & -mask).bit_length() - 1


@pytest.mark.parametrize("mask", range(256))
def test_put(mask):
    out = np.full(16, -7, np.int32)
    size = lanes.put(out, 3, 40, mask)
    expected = [40 + lane for lane in range(8) if mask >> lane & 1]
    assert size == 3 + len(expected)
    assert out[3:size].tolist() == expected
    assert (out[:3] == -7).all()
    assert (out[11:] == -7).all(), "only eight places are written"
