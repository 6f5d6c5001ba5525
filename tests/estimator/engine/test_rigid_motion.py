"""Horn's method against motions that are known, and against Kabsch's."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from estimator.engine.rigid_motion import rigid_motion
from tests.estimator.test_icp import rigid_motion as kabsch


def found(source: np.ndarray, target: np.ndarray) -> tuple[np.ndarray, float]:
    """The motion (4, 4) of points paired by rows, and the gap as a share of the eigenvalue."""
    rows, motion = np.arange(len(source)), np.eye(4)
    eigenvalue, gap = rigid_motion(source, target, rows, rows, len(source), motion)
    return motion, gap / eigenvalue if eigenvalue else 0.0


@pytest.mark.parametrize("degrees", [0.0, 1e-6, 1.0, 90.0, 179.0, 180.0])
@pytest.mark.parametrize("seed", range(5))
def test_a_motion_is_found_again(degrees, seed):
    rng = np.random.default_rng(seed)
    axis = rng.normal(size=3)
    R = Rotation.from_rotvec(np.radians(degrees) * axis / np.linalg.norm(axis)).as_matrix()
    source, t = rng.normal(size=(20, 3)), rng.normal(size=3)
    motion, gap = found(source, source @ R.T + t)
    assert motion[:3, :3] == pytest.approx(R, abs=1e-13)
    assert motion[:3, 3] == pytest.approx(t, abs=1e-13)
    assert gap > 0.01


@pytest.mark.parametrize("flat", [False, True])
@pytest.mark.parametrize("seed", range(20))
def test_the_best_motion_of_pairs_without_one_is_kabschs(flat, seed):
    rng = np.random.default_rng(seed)
    source, target = rng.normal(size=(2, 30, 3))
    if flat:
        source[:, 2] = 0.0
    motion, gap = found(source, target)
    assert gap > 1e-3
    assert motion == pytest.approx(kabsch(source, target), abs=1e-12)
    assert np.linalg.det(motion[:3, :3]) == pytest.approx(1.0)


def test_the_gap_tells_a_rotation_that_is_open():
    line = np.outer(np.arange(5.0), [1.0, 2.0, 3.0])
    assert found(line, line + 1.0)[1] < 1e-12
    assert found(line[:2], line[:2])[1] < 1e-12
    assert found(np.ones((3, 3)), np.ones((3, 3)))[1] == 0.0


def test_one_pair_is_moved_without_turning():
    motion, _ = found(np.array([[0.1, 0.2, 0.3]]), np.array([[1.0, 1.0, 1.5]]))
    assert motion[:3, :3].tolist() == np.eye(3).tolist()
    assert motion[:3, 3] == pytest.approx([0.9, 0.8, 1.2])
