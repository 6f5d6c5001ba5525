"""The point that a person points at."""

from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from app.analysis.estimates import Estimates
from app.analysis.pointing import DrawnPoints, Sight, point_at
from app.analysis.zones import SOURCE, TARGET, cluster_of_point
from estimator import Parameters
from tests.app.fake_recordings import fake_opened

EYE = np.array([0.3, -3.0, 1.0])
FOV = 0.66


@pytest.fixture(scope="module")
def pair():
    return Estimates().estimated(fake_opened(), 20, Parameters())


def drawn(pair) -> Any:
    sizes = {SOURCE: len(pair.source.points), TARGET: len(pair.target.points)}
    return {side: clear(np.ones(size, dtype=bool)) for side, size in sizes.items()}


def clear(shown) -> DrawnPoints:
    return DrawnPoints(shown, shown)


def pointed(pair, shown: Any, sight: Sight) -> Any:
    return point_at(pair, shown, sight)


def towards(point, near=0.1) -> Sight:
    return Sight.through(EYE, 7 * (point - EYE), near, FOV)


def test_a_ray_finds_the_point_that_it_passes(pair):
    for index in range(0, 500, 30):
        point = pair.target.points[index]
        hit = pointed(pair, drawn(pair), towards(point))
        assert hit is not None
        found = (pair.source if hit.side == SOURCE else pair.target).points[hit.index]
        np.testing.assert_allclose(found, point, atol=1e-12)
        assert hit.angle == pytest.approx(0.0, abs=1e-6)


def test_it_finds_only_what_is_drawn_and_lies_before_the_eye(pair):
    point = pair.target.points[450]
    aimed = towards(point)
    assert pointed(pair, {TARGET: drawn(pair)[TARGET]}, aimed).side == TARGET
    hidden = {TARGET: clear(np.arange(500) < 400)}
    assert pointed(pair, hidden, aimed) is None
    assert pointed(pair, {}, aimed) is None
    assert pointed(pair, drawn(pair), towards(point, near=50.0)) is None
    assert pointed(pair, drawn(pair), towards(2 * EYE - point)) is None
    assert pointed(replace(pair, source=None), drawn(pair), aimed).side == TARGET


def test_a_point_is_found_within_some_pixels_and_not_further(pair):
    point = pair.target.points[0]
    aside = np.cross(point - EYE, [0.0, 0.0, 1.0])
    aside /= np.linalg.norm(aside)
    pixel = 2 * np.tan(FOV / 2) * np.linalg.norm(point - EYE) / 720
    corner = {TARGET: clear(np.arange(500) == 0)}
    assert pointed(pair, corner, towards(point + 9 * pixel * aside)) is not None
    assert pointed(pair, corner, towards(point + 16 * pixel * aside)) is None


def test_what_stands_out_comes_before_what_stands_back(pair):
    point = pair.target.points[0]
    aside = np.cross(point - EYE, [0.0, 0.0, 1.0])
    pixel = 2 * np.tan(FOV / 2) * np.linalg.norm(point - EYE) / 720 / np.linalg.norm(aside)
    near = replace(pair.target, points=np.stack([point, point + 6 * pixel * aside]))
    two, both = replace(pair, target=near), np.ones(2, dtype=bool)

    def found(pixels, moving) -> int:
        points = {TARGET: DrawnPoints(both, np.array(moving))}
        return pointed(two, points, towards(point + pixels * pixel * aside)).index

    assert found(2, [True, True]) == 0
    assert found(2, [False, True]) == 1
    assert found(0.5, [False, True]) == 0
    assert found(2, [False, False]) == 0


def test_a_point_belongs_to_its_cluster(pair):
    assert cluster_of_point(pair, SOURCE, 450) == pair.flow.cluster[450]
    assert cluster_of_point(pair, TARGET, 450) == pair.flow.cluster[450]
    assert cluster_of_point(replace(pair, flow=None), SOURCE, 450) is None
