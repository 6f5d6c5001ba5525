"""HDBSCAN against scikit-learn in the same process, labels and probabilities bit for bit."""

import os
import subprocess
import sys
import warnings
from concurrent.futures import ThreadPoolExecutor
from typing import Any

import numpy as np
import pytest
from sklearn.cluster import HDBSCAN

from estimator.engine.hdbscan import hdbscan
from recordings import open_recording, sample_paths
from tests.estimator.engine.clouds import KINDS, cloud_of

RUNS = int(os.environ.get("TOFSCOPE_CLOUDS", "112"))
"""Clouds of each kind: 2,016 in all."""


def agrees(cloud: np.ndarray, **settings: Any) -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", RuntimeWarning)  # of infinite densities
        expected = HDBSCAN(copy=True, **settings).fit(cloud)  # type: ignore[arg-type]
    label, probability = hdbscan(cloud, **settings, order="quicksort")
    assert label.tolist() == expected.labels_.tolist()
    np.testing.assert_array_equal(probability, expected.probabilities_)


def settings_of(rng: np.random.Generator, size: int) -> dict[str, Any]:
    most = min(size, 60)
    return {
        "min_cluster_size": int(rng.integers(2, most + 1)),
        "min_samples": None if rng.uniform() < 0.5 else int(rng.integers(1, min(most, 40) + 1)),
        "allow_single_cluster": bool(rng.uniform() < 0.3),
    }


@pytest.mark.parametrize("kind", KINDS)
def test_random_clouds(kind):
    rng = np.random.default_rng(list(KINDS).index(kind))
    for _ in range(RUNS):
        cloud = cloud_of(kind, rng)
        agrees(cloud, **settings_of(rng, len(cloud)))


@pytest.mark.parametrize("size", [2, 3, 7, 8, 9, 63, 64, 65, 511, 512, 513])
def test_sizes_about_those_of_blocks(size):
    rng = np.random.default_rng(size)
    for _ in range(5):
        agrees(rng.normal(size=(size, 3)), **settings_of(rng, size))


@pytest.fixture(scope="module")
def merged() -> list[np.ndarray]:
    """Merged clouds of the samples' pairs."""
    clouds = []
    for path in sample_paths():
        with open_recording(path) as recording:
            for k in range(8, len(recording), 4):
                pair = recording.cloud(k).points, recording.cloud(k - 8).points
                clouds.append(np.vstack(pair))
    return clouds


@pytest.mark.parametrize("min_cluster_size", [5, 20, 40])
def test_pairs_of_the_samples(merged, min_cluster_size):
    for cloud in merged:
        agrees(cloud, min_cluster_size=min_cluster_size)


def test_twice_as_many_points(merged):
    for one, other in zip(merged[::4], merged[2::4], strict=False):
        agrees(np.vstack([one, other]), min_cluster_size=20)


def test_equal_distances_are_taken_in_the_order_of_the_points(merged):
    rounded = merged[0].round(2)
    first = hdbscan(rounded, 20)
    with ThreadPoolExecutor(2) as pool:
        for again in pool.map(lambda _: hdbscan(rounded, 20), range(8)):
            assert again[0].tolist() == first[0].tolist()
            assert again[1].tolist() == first[1].tolist()


def test_any_layout_of_the_points_will_do(merged):
    cloud = merged[0].astype(np.float32).astype(np.float64)
    expected = hdbscan(cloud, 20)[0].tolist()
    read_only = cloud.copy()
    read_only.setflags(write=False)
    for same in (read_only, np.asfortranarray(cloud), cloud.astype(np.float32), cloud[::-1][::-1]):
        before = same.copy()
        assert hdbscan(same, 20)[0].tolist() == expected
        assert (same == before).all()


@pytest.mark.skipif("TOFSCOPE_BOUNDS" not in os.environ, reason="compiles for a minute")
def test_no_index_is_out_of_bounds(tmp_path):
    checked = {"NUMBA_BOUNDSCHECK": "1", "NUMBA_CACHE_DIR": str(tmp_path), "TOFSCOPE_CLOUDS": "10"}
    command = [sys.executable, "-m", "pytest", __file__, "-q", "-k", "random or sizes"]
    done = subprocess.run(command, env=os.environ | checked, check=False, capture_output=True)
    assert done.returncode == 0, done.stdout.decode()
