"""The size test, and one ICP round over a cluster."""

import numpy as np
import pytest

from estimator import Parameters, window_of_pair
from estimator.rounds import icp_round, too_few_points
from tests.estimator.scenes import corner


@pytest.mark.parametrize(
    ("sizes", "n_min", "enough"),
    [
        ((59, 59), 60, False),
        ((60, 59), 60, True),
        ((59, 60), 60, True),
        ((60, 60), 60, True),
        ((2, 100), 60, False),
        ((100, 2), 60, False),
        ((3, 100), 60, True),
        ((2, 2), 1, False),
        ((3, 3), 1, True),
        ((0, 0), 1, False),
        ((0, 100), 60, False),
    ],
)
def test_both_clouds_must_be_below_n_min_and_icp_needs_three(sizes, n_min, enough):
    source, target = (np.arange(size) for size in sizes)
    reason = too_few_points(source, target, Parameters(n_min=n_min))
    assert (reason is None) is enough
    if reason is not None:
        assert f"{sizes[0]} source and {sizes[1]} target points" in reason


def test_the_reason_names_n_min():
    assert too_few_points(np.arange(5), np.arange(6), Parameters(n_min=7)) == (
        "5 source and 6 target points, both below N_min 7"
    )


def test_a_round_tells_what_icp_did_to_these_points():
    rng = np.random.default_rng(0)
    cloud, displacement = rng.uniform(5, 9, (300, 3)), np.array([0.03, -0.04, 0.0])
    source, target = np.arange(40, 140), np.arange(90, 190)
    moving = corner(rng)
    cloud_source, cloud_target = cloud.copy(), cloud.copy()
    cloud_source[source], cloud_target[target] = moving, moving + displacement

    window = window_of_pair(cloud_source, cloud_target, 0.5)
    current, moved = icp_round(source, target, window, Parameters())
    assert moved.shape == (100, 3)
    assert moved == pytest.approx(np.broadcast_to(displacement, (100, 3)), abs=1e-6)
    assert current.mean_displacement == pytest.approx(0.05, abs=1e-6)
    assert (current.source_size, current.target_size) == (100, 100)
    assert current.fitness == 1.0
    assert current.inlier_source.tolist() == source.tolist()
    assert current.inlier_target.tolist() == target.tolist()


def test_mean_displacement_is_the_mean_of_the_lengths():
    # A turn about the middle moves every point and the middle not at all.
    rng = np.random.default_rng(0)
    points = rng.uniform(-0.2, 0.2, (200, 3))
    points -= points.mean(axis=0)
    angle = 0.1
    R = np.array([[np.cos(angle), -np.sin(angle), 0], [np.sin(angle), np.cos(angle), 0], [0, 0, 1]])
    window = window_of_pair(points, points @ R.T, 1.0)
    current, moved = icp_round(np.arange(200), np.arange(200), window, Parameters())
    assert moved.mean(axis=0) == pytest.approx([0, 0, 0], abs=1e-9)
    expected = 2 * np.sin(angle / 2) * np.linalg.norm(points[:, :2], axis=1).mean()
    assert current.mean_displacement == pytest.approx(expected, abs=1e-9)
