"""Clouds and intervals that an estimate accepts."""

import math
from dataclasses import dataclass

import numpy as np
import pytest

from estimator import CloudError
from estimator.window import window_of_pair

ONE = [[1.0, 2.0, 3.0]]


@dataclass(frozen=True)
class RecordedCloud:
    points: np.ndarray


@pytest.mark.parametrize("empty", [[], np.zeros(0), np.zeros((0, 3)), ()])
def test_an_empty_cloud_has_no_points(empty):
    window = window_of_pair(empty, ONE, 0.5)
    assert window.source.points.shape == (0, 3)
    assert window.target.points.shape == (1, 3)


@pytest.mark.parametrize("kind", [list, np.float32, np.int64])
def test_numbers_become_float64(kind):
    points = ONE if kind is list else np.array(ONE, dtype=kind)
    window = window_of_pair(points, points, 1)
    assert window.source.points.dtype == np.float64
    assert window.source.points.tolist() == ONE
    assert window.interval == 1.0


def test_a_cloud_with_points_is_taken_as_it_is():
    points = np.array(ONE)
    window = window_of_pair(RecordedCloud(points), points, 0.5)
    assert np.shares_memory(window.source.points, points)


@pytest.mark.parametrize(
    "points", [[1.0, 2.0, 3.0], [[1.0, 2.0]], np.zeros((2, 4)), np.zeros((1, 1, 3)), 5.0, None]
)
@pytest.mark.parametrize("place", ["source", "target"])
def test_a_wrong_shape_is_one_sentence_that_says_where(points, place):
    clouds = {"source": ONE, "target": ONE, place: points}
    with pytest.raises(CloudError) as caught:
        window_of_pair(clouds["source"], clouds["target"], 0.5)
    assert str(caught.value).startswith(f"The {place} must have the shape (N, 3), got (")


@pytest.mark.parametrize("points", [np.zeros((3, 0)), np.zeros((0, 2)), [[]]])
def test_an_empty_array_of_another_shape_is_no_cloud(points):
    with pytest.raises(CloudError, match=r"must have the shape \(N, 3\)"):
        window_of_pair(points, ONE, 0.5)


@pytest.mark.parametrize("points", ["abc", [["a", "b", "c"]], [[1.0, 2.0, 3.0], [1.0]], [{}]])
def test_what_holds_no_numbers_is_refused(points):
    with pytest.raises(CloudError, match=r"^The target must hold numbers"):
        window_of_pair(ONE, points, 0.5)


def test_lengths_whose_squares_overflow_are_refused():
    with pytest.raises(CloudError, match=r"^The target must lie within 1e\+100 m, got 1e\+200 m\."):
        window_of_pair(ONE, [[0.0, -1e200, np.nan]], 0.5)
    assert window_of_pair(ONE, [[0.0, 1e100, np.inf]], 0.5).target.points[0, 1] == 1e100


@pytest.mark.parametrize("interval", [0, 0.0, -0.5, math.nan, math.inf, -math.inf, None, "1", [1]])
def test_an_interval_is_a_number_of_seconds_above_zero(interval):
    with pytest.raises(CloudError, match=r"^The interval must be a finite number of seconds"):
        window_of_pair(ONE, ONE, interval)


@pytest.mark.parametrize("interval", [1, np.float32(0.5), np.float64(0.5), np.int64(2)])
def test_any_kind_of_number_is_an_interval(interval):
    window = window_of_pair(ONE, ONE, interval)
    assert window.interval == float(interval)
    assert isinstance(window.interval, float)
