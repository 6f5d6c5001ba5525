"""The compiled ICP against Open3D's."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from benchmarks.registration import sample_registrations
from estimator.engine import registration
from estimator.engine.registration import align
from estimator.icp import align as align_open3d
from tests.estimator.scenes import corner


def is_open3ds(source: np.ndarray, target: np.ndarray, reach: float) -> bool:
    """Whether there is an answer, which has to be Open3D's."""
    found, expected = align(source, target, reach), align_open3d(source, target, reach)
    if found is None:
        return False
    scale = max(1.0, np.abs(source).max(), np.abs(target).max())
    assert found.inlier_source.tolist() == expected.inlier_source.tolist()
    assert found.inlier_target.tolist() == expected.inlier_target.tolist()
    assert found.inlier_source.dtype == found.inlier_target.dtype == np.intp
    assert found.fitness == expected.fitness
    assert found.inlier_rmse == pytest.approx(expected.inlier_rmse, rel=0, abs=1e-12 * scale)
    R, t = found.transformation[:3, :3], found.transformation[:3, 3]
    assert pytest.approx(expected.transformation[:3, :3], rel=0, abs=1e-9) == R
    assert pytest.approx(expected.transformation[:3, 3], rel=0, abs=1e-9 * scale) == t
    assert found.transformation[3].tolist() == [0.0, 0.0, 0.0, 1.0]
    return True


def patch(rng: np.random.Generator) -> np.ndarray:
    return rng.normal(size=(120, 3)) * rng.uniform(0.05, 0.3, 3)


def plane(rng: np.random.Generator) -> np.ndarray:
    return rng.uniform(0.0, 0.6, (120, 3)) * (1.0, 1.0, 0.0)


def seen_again(rng: np.random.Generator, source: np.ndarray) -> np.ndarray:
    """A part of the points, moved, with noise, in another order."""
    turned = Rotation.from_rotvec(rng.normal(size=3) * 0.05).apply(source)
    target = turned + rng.normal(size=3) * 0.03 + rng.normal(size=source.shape) * 0.005
    return target[rng.permutation(len(target))[: len(target) * 4 // 5]]


VARIANTS = {
    "tiny reach": lambda source, target: (source, target, 1e-6),
    "short reach": lambda source, target: (source, target, 0.02),
    "default": lambda source, target: (source, target, 0.1),
    "endless reach": lambda source, target: (source, target, 100.0),
    "static": lambda source, target: (source, source.copy(), 0.1),
    "no overlap": lambda source, target: (source, target + 10.0, 0.1),
    "huge": lambda source, target: (source * 1e6, target * 1e6, 1e5),
    "far away": lambda source, target: (source + 1e3, target + 1e3, 0.1),
    "millimetres": lambda source, target: (source.round(3), target.round(3), 0.1),
}


@pytest.mark.parametrize("variant", VARIANTS)
@pytest.mark.parametrize("shape", [corner, plane, patch])
def test_shapes_seen_again(shape, variant):
    answered = 0
    for seed in range(20):
        rng = np.random.default_rng(seed)
        source = shape(rng)
        answered += is_open3ds(*VARIANTS[variant](source, seen_again(rng, source)))
    assert answered >= 15


def test_centimetres_have_ties_which_are_left_to_open3d():
    answered = 0
    for seed in range(20):
        rng = np.random.default_rng(seed)
        source = patch(rng)
        answered += is_open3ds(source.round(2), seen_again(rng, source).round(2), 0.1)
    assert answered < 10


@given(
    seed=st.integers(0, 10**6),
    sizes=st.tuples(st.integers(1, 12), st.integers(1, 12)),
    step=st.sampled_from([0.0, 0.01, 0.05]),
)
def test_a_handful_of_points(seed, sizes, step):
    rng = np.random.default_rng(seed)
    source, target = (rng.uniform(0.0, 0.2, (size, 3)) for size in sizes)
    if step:
        source, target = np.round(source / step) * step, np.round(target / step) * step
    is_open3ds(source, target, 0.1)


def test_one_point_is_moved_onto_the_nearest():
    source, target = np.array([[0.1, 0.2, 0.3]]), np.array([[0.13, 0.2, 0.3], [0.1, 0.2, 0.39]])
    assert is_open3ds(source, target, 0.1)
    found = align(source, target, 0.1)
    assert found is not None
    assert found.transformation[:3, 3] == pytest.approx([0.03, 0.0, 0.0])


def test_what_rounding_decides_has_no_answer():
    rng = np.random.default_rng(0)
    source = corner(rng)
    line = np.outer(np.linspace(0.0, 1.0, 9), [1.0, 2.0, 3.0])
    two = np.array([[0.0, 0.0, 0.0], [0.0, 0.0, 1.0]])
    assert align(two, two + 0.01, 0.1) is None  # turns about the line between them
    assert align(line, line + 0.01, 0.1) is None
    assert align(source, np.vstack([source, source]), 0.1) is None
    assert align(np.ones((5, 3)), np.ones((5, 3)), 0.1) is None
    assert align(np.zeros((1, 3)), np.array([[0.1, 0.0, 0.0]]), 0.1) is None  # at the limit


@pytest.mark.parametrize("wrong", [np.nan, np.inf, -np.inf, 1e300])
def test_what_cannot_be_compared_has_no_answer(wrong):
    source = corner(np.random.default_rng(0))
    odd = source.copy()
    odd[7, 1] = wrong
    assert align(source, odd, 0.1) is None
    assert align(odd, source, 0.1) is None
    assert align(source, source[:0], 0.1) is None
    assert align(source[:0], source, 0.1) is None
    assert align(source, source, 0.0) is None


def test_it_compiles_once_whatever_the_arrays_are():
    source = corner(np.random.default_rng(0))
    read_only = source.copy()
    read_only.setflags(write=False)
    for given_source in (
        source,
        read_only,
        np.asfortranarray(source),
        source[::2],
        source.tolist(),
    ):
        assert align(np.asarray(given_source), read_only, 0.1) is not None
    assert len(registration._align.signatures) == 1  # pyright: ignore[reportFunctionMemberAccess]


def test_the_points_given_stay_where_they_are():
    rng = np.random.default_rng(0)
    source = corner(rng)
    target = seen_again(rng, source)
    before = source.copy(), target.copy()
    align(source, target, 0.1)
    assert source.tolist() == before[0].tolist()
    assert target.tolist() == before[1].tolist()


def test_every_icp_of_the_samples():
    answered = [is_open3ds(*one) for one in sample_registrations()]
    assert len(answered) > 500
    assert np.mean(answered) > 0.9
