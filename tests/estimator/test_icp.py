"""ICP against a plain implementation, and against motions that are known."""

import numpy as np
import pytest
from scipy.spatial import KDTree
from scipy.spatial.transform import Rotation

from estimator.engine import registration as engine
from estimator.icp import align as align_open3d
from tests.estimator.scenes import corner


@pytest.fixture(params=[align_open3d, engine.align], ids=["open3d", "compiled"])
def align(request):
    return request.param


def rigid_motion(source: np.ndarray, target: np.ndarray) -> np.ndarray:
    """The least-squares rigid motion (4, 4) of paired points (Kabsch)."""
    middle_source, middle_target = source.mean(axis=0), target.mean(axis=0)
    U, _, Vt = np.linalg.svd((source - middle_source).T @ (target - middle_target))
    flip = np.diag([1.0, 1.0, np.sign(np.linalg.det(Vt.T @ U.T))])
    T = np.eye(4)
    T[:3, :3] = Vt.T @ flip @ U.T
    T[:3, 3] = middle_target - T[:3, :3] @ middle_source
    return T


def plain_icp(source: np.ndarray, target: np.ndarray, reach: float):
    """Point-to-point ICP from the identity: transformation, fitness, rmse, pairs (K, 2)."""

    def evaluate(points: np.ndarray):
        distance, nearest = tree.query(points, distance_upper_bound=reach)
        distance, nearest = np.asarray(distance), np.asarray(nearest)
        paired = np.flatnonzero(np.isfinite(distance))
        pairs = np.column_stack([paired, nearest[paired]])
        rmse = np.sqrt(np.mean(distance[paired] ** 2)) if len(paired) else 0.0
        return len(paired) / len(points), rmse, pairs

    tree, T, moved = KDTree(target), np.eye(4), source
    fitness, rmse, pairs = evaluate(moved)
    for _ in range(30):
        step = rigid_motion(moved[pairs[:, 0]], target[pairs[:, 1]])
        T, moved = step @ T, moved @ step[:3, :3].T + step[:3, 3]
        before = fitness, rmse
        fitness, rmse, pairs = evaluate(moved)
        if abs(before[0] - fitness) < 1e-6 and abs(before[1] - rmse) < 1e-6:
            break
    return T, fitness, rmse, pairs


@pytest.mark.parametrize("seed", range(20))
def test_a_plain_implementation_finds_the_same(align, seed):
    rng = np.random.default_rng(seed)
    source = corner(rng, 150, 0.4)
    turned = Rotation.from_rotvec(rng.normal(size=3) * 0.05).apply(source)
    target = turned + rng.normal(size=3) * 0.03 + rng.normal(size=source.shape) * 0.005
    target = target[rng.permutation(len(target))[:120]]

    found = align(source, target, 0.1)
    T, fitness, rmse, pairs = plain_icp(source, target, 0.1)
    assert found.transformation == pytest.approx(T, abs=1e-9)
    assert found.fitness == pytest.approx(fitness)
    assert found.inlier_rmse == pytest.approx(rmse)
    found_pairs = np.column_stack([found.inlier_source, found.inlier_target])
    assert sorted(found_pairs.tolist()) == sorted(pairs.tolist())


@pytest.mark.parametrize("length", [0.0, 0.02, 0.05, 0.09])
@pytest.mark.parametrize("seed", range(5))
def test_a_translated_shape_gives_that_translation(align, length, seed):
    rng = np.random.default_rng(seed)
    source = corner(rng)
    direction = rng.normal(size=3)
    displacement = length * direction / np.linalg.norm(direction)
    found = align(source, source + displacement, 0.1)
    assert found.transformation[:3, :3] == pytest.approx(np.eye(3), abs=1e-6)
    assert found.transformation[:3, 3] == pytest.approx(displacement, abs=1e-6)
    assert found.fitness == 1.0
    assert found.inlier_rmse == pytest.approx(0.0, abs=1e-6)
    assert found.inlier_source.tolist() == found.inlier_target.tolist() == list(range(100))


def test_it_takes_the_source_onto_the_target_and_not_back(align):
    rng = np.random.default_rng(0)
    source = corner(rng)
    R, t = Rotation.from_euler("xyz", [3, -2, 4], degrees=True), np.array([0.02, -0.01, 0.03])
    target = R.apply(source) + t
    found = align(source, target, 0.1)
    assert found.transformation[:3, :3] == pytest.approx(R.as_matrix(), abs=1e-6)
    assert found.transformation[:3, 3] == pytest.approx(t, abs=1e-6)


def test_fitness_counts_source_points(align):
    near = corner(np.random.default_rng(0), 30)
    far = near[:10] + 5.0
    more_source, more_target = np.vstack([near, far]), np.vstack([near, far, far + 1.0])
    assert align(more_source, near, 0.1).fitness == 0.75
    assert align(near, more_target, 0.1).fitness == 1.0


def test_out_of_reach_nothing_is_paired_and_nothing_moves(align):
    source = corner(np.random.default_rng(0))
    found = align(source, source + 10.0, 0.1)
    assert found.fitness == 0.0
    assert found.transformation.tolist() == np.eye(4).tolist()
    assert found.inlier_source.shape == found.inlier_target.shape == (0,)
    assert found.inlier_source.dtype.kind == "i"


def test_reach_bounds_the_distance_of_a_pair(align):
    lattice = np.stack(np.meshgrid(*[np.arange(4.0)] * 3), axis=-1).reshape(-1, 3)
    target = lattice.copy()
    target[:8] += (0.0, 0.0, 0.2)
    inside = align(lattice, target, 0.25)
    assert inside.fitness == 1.0
    outside = align(lattice, target, 0.15)
    assert outside.fitness == 56 / 64
    assert outside.transformation == pytest.approx(np.eye(4), abs=1e-12)
