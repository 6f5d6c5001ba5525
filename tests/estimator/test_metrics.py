from dataclasses import asdict
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from estimator import METRIC_INFO, Label, Metrics, PooledErrors, SceneFlow, angles_deg


def flow(velocity: np.ndarray) -> SceneFlow:
    """A flow of points; rows of NaN are stationary."""
    label = np.where(np.isfinite(velocity).all(axis=1), Label.MOVING, Label.STATIONARY)
    return SceneFlow(label.astype(np.int64), velocity, np.zeros(len(velocity), np.int64), ())


NONE = [np.nan, np.nan, np.nan]
MEANS = {name for name, info in METRIC_INFO.items() if info.kind != "count"}
SHARES = {name for name, info in METRIC_INFO.items() if info.kind == "share"}


def still(size: int) -> np.ndarray:
    return np.zeros((size, 3))


def test_errors_of_a_case_worked_by_hand():
    errors = PooledErrors()
    truth = np.tile([0.0, -0.2, 0.0], (4, 1))
    points = np.array([[0, -0.2, 0], [0, -0.2, 0], [0, 0, 0], [0, 0, 0]])
    errors.add(flow(np.array([[0, -0.2, 0], NONE, [0.2, 0, 0], NONE])), 0.5, truth, points)
    metrics = errors.metrics()
    assert metrics.pairs == 1
    assert metrics.points_with_flow == 2
    assert metrics.angle_deg == pytest.approx(45.0)
    assert metrics.velocity_error == pytest.approx(0.2 * np.sqrt(2) / 2)
    assert metrics.coverage == 0.5
    assert metrics.precision == 0.5
    assert metrics.epe3d == pytest.approx((0 + 0.1 + 0.1 + 0) / 4)


def test_the_fields_metrics_of_a_case_worked_by_hand():
    """Ways of 0.1 m over half a second, and what each point's flow makes of them."""
    errors = PooledErrors()
    moves, rests = [0.2, 0, 0], [0.0, 0, 0]
    cases = [
        # found, truth (m/s)         e in m, r                  AccS   AccR   outlier
        ([0.2, 0, 0], moves),  #     0,      0                  yes    yes    no
        ([0.289, 0, 0], moves),  #   0.0445, 0.445              yes    yes    yes
        ([0.2, 0.12, 0], moves),  #  0.06,   0.6                no     yes    yes
        (NONE, moves),  #            0.1,    just below 1       no     no     yes
        ([0.2, 0, 0], rests),  #     0.1,    1000               no     no     yes
        ([0, 0, 0.16], rests),  #    0.08,   800                no     yes    yes
        (NONE, rests),  #            0,      0                  yes    yes    no
        ([40.0, 1.9, 0], [40, 0, 0]),  # 0.95, 0.0475           yes    yes    yes, for 0.95 m
        ([4.0, 0.5, 0], [4, 0, 0]),  # 0.25, 0.125              no     no     yes, for 0.125
        ([4.0, 0.38, 0], [4, 0, 0]),  # 0.19, 0.095             no     yes    no
    ]
    found, truth = (np.array(column, dtype=float) for column in zip(*cases, strict=True))
    errors.add(flow(found), 0.5, truth, truth)
    metrics = errors.metrics()
    ways = [0, 0.0445, 0.06, 0.1, 0.1, 0.08, 0, 0.95, 0.25, 0.19]
    assert metrics.epe3d == pytest.approx(np.mean(ways))
    assert metrics.acc_s == 4 / 10
    assert metrics.acc_r == 7 / 10
    assert metrics.outliers == 7 / 10
    assert metrics.dynamic_iou == 6 / (6 + 2 + 1)
    assert metrics.false_flow == 2 / 3
    assert metrics.coverage == 6 / 7
    assert metrics.precision == 6 / 8


def test_the_relative_error_is_relative_to_the_way_and_a_tenth_of_a_millimetre():
    def outliers(way: float, off: float) -> float:
        errors = PooledErrors()
        truth = np.array([[way, 0, 0]])
        errors.add(flow(truth + np.array([[0, off, 0]])), 1.0, truth, truth)
        return errors.metrics().outliers

    assert outliers(0.0, 1.1e-5) == 1.0
    assert outliers(0.0, 0.9e-5) == 0.0
    assert outliers(1e-3, 1.09e-4) == 0.0
    assert outliers(1e-3, 1.11e-4) == 1.0


def test_pairs_at_which_nothing_moves_tell_of_false_flow_alone():
    errors = PooledErrors()
    errors.add_resting(flow(np.array([[0.3, 0, 0], NONE, NONE, [1.0, 0, 0], NONE])), still(5))
    metrics = errors.metrics()
    assert metrics.pairs == metrics.points_with_flow == 0
    assert metrics.false_flow == 2 / 5
    others = {k: v for k, v in asdict(metrics).items() if k in MEANS and k != "false_flow"}
    assert np.isnan(list(others.values())).all()


def test_false_flow_is_pooled_over_pairs_that_count_and_pairs_that_do_not():
    errors = PooledErrors()
    truth = np.array([[0.2, 0, 0], [0, 0, 0], NONE, [0.009, 0, 0]])
    errors.add(flow(np.tile([0.2, 0, 0], (4, 1))), 0.5, np.tile([0.2, 0, 0], (4, 1)), truth)
    errors.add_resting(flow(np.array([NONE] * 4)), truth)
    assert errors.metrics().pairs == 1
    assert errors.metrics().false_flow == 2 / 4


@st.composite
def pairs(draw: st.DrawFn) -> tuple[SceneFlow, float, np.ndarray, np.ndarray]:
    """A pair of up to 40 points: some move, some rest, some are unknown; some got a flow."""
    generator = np.random.default_rng(draw(st.integers(0, 2**32 - 1)))
    size = draw(st.integers(0, 40))
    scale = draw(st.sampled_from([0.01, 0.2, 3.0]))
    truth = generator.normal(scale=scale, size=(size, 3)) * generator.integers(0, 2, (size, 1))
    found = truth + generator.normal(scale=scale / 4, size=(size, 3))
    found[generator.uniform(size=size) < 0.4] = np.nan
    truth[generator.uniform(size=size) < 0.1] = np.nan
    interval = draw(st.floats(0.01, 2.0))
    return flow(found), interval, np.full((size, 3), 0.2), truth


def pooled(*pairs: tuple[SceneFlow, float, np.ndarray, np.ndarray]) -> Metrics:
    errors = PooledErrors()
    for pair in pairs:
        errors.add(*pair)
    return errors.metrics()


def same(a: Metrics, b: Metrics, but: tuple[str, ...] = ("pairs",)) -> bool:
    one, two = ({k: v for k, v in asdict(m).items() if k not in but} for m in (a, b))
    return one == pytest.approx(two, rel=1e-9, nan_ok=True)


@given(pairs())
def test_shares_are_shares_and_strict_is_stricter(pair):
    metrics = pooled(pair)
    for name in SHARES:
        value = getattr(metrics, name)
        assert np.isnan(value) or 0 <= value <= 1
    if np.isfinite(metrics.epe3d):
        assert metrics.epe3d >= 0
        assert metrics.acc_s <= metrics.acc_r
        assert metrics.acc_r + metrics.outliers >= 1 - 1e-12  # neither: 0.1 < e, r < 0.1, no
    if np.isfinite([metrics.coverage, metrics.precision]).all() and metrics.coverage:
        union = 1 / metrics.coverage + 1 / metrics.precision - 1
        assert metrics.dynamic_iou == pytest.approx(1 / union)


@given(pairs(), st.integers(0, 2**32 - 1))
def test_the_order_of_points_does_not_matter(pair, seed: int):
    found, interval, velocity, truth = pair
    order = np.random.default_rng(seed).permutation(len(truth))
    shuffled = (flow(found.velocity[order]), interval, velocity[order], truth[order])
    assert same(pooled(pair), pooled(shuffled), but=())


@given(pairs(), st.integers(0, 40))
def test_the_parts_of_a_pair_pool_to_the_whole(pair, cut: int):
    found, interval, velocity, truth = pair
    parts = [
        (flow(found.velocity[part]), interval, velocity[part], truth[part])
        for part in (slice(None, cut), slice(cut, None))
    ]
    assert same(pooled(pair), pooled(*parts))


@given(pairs(), st.floats(0.1, 10))
def test_a_way_is_the_same_at_half_the_speed_for_twice_the_time(pair, factor: float):
    found, interval, velocity, truth = pair
    truth = np.where(np.linalg.norm(truth, axis=1, keepdims=True) < 0.2, 0 * truth, truth)
    slower = (flow(found.velocity / factor), interval * factor, velocity / factor, truth / factor)
    but = tuple(name for name, info in METRIC_INFO.items() if info.unit == "m/s")
    assert same(pooled((found, interval, velocity, truth)), pooled(slower), but)


@given(pairs())
def test_the_truth_itself_has_no_error(pair):
    _, interval, velocity, truth = pair
    moves = np.linalg.norm(truth, axis=1, keepdims=True) > 0.01
    metrics = pooled((flow(np.where(moves, truth, np.nan)), interval, velocity, truth))
    if np.isfinite(metrics.epe3d):
        assert metrics.epe3d < 0.01 * interval
        assert metrics.acc_s == 1
    for value in (metrics.coverage, metrics.precision, metrics.dynamic_iou):
        assert np.isnan(value) or value == 1
    assert np.isnan(metrics.false_flow) or metrics.false_flow == 0


def test_a_peers_estimate_scores_what_the_peer_says(shared_data: Path):
    """ICP-Flow's demo: lidar on a street, its own estimate, and an error of 0.0114 m."""
    data = np.load(shared_data / "scene_flow" / "icp_flow_demo.npz")
    valid = data["pc1_flows_valid_idx"]
    truth = data["gt_flow_0_1"][valid].astype(np.float64)
    estimate = data["est_flow"].astype(np.float64)
    interval = 0.1
    velocity = estimate / interval
    metrics = pooled((flow(velocity), interval, truth / interval, truth / interval))
    assert metrics.epe3d == pytest.approx(0.0114, abs=5e-5)
    ways = [float(np.sqrt(sum(x * x for x in row))) for row in truth.tolist()]
    ends = [float(np.sqrt(sum(x * x for x in row))) for row in (estimate - truth).tolist()]
    both = list(zip(ends, ways, strict=True))
    strict = sum(e < 0.05 or e < 0.05 * (w + 1e-4) for e, w in both)
    relaxed = sum(e < 0.1 or e < 0.1 * (w + 1e-4) for e, w in both)
    outlying = sum(e > 0.3 or e > 0.1 * (w + 1e-4) for e, w in both)
    assert metrics.acc_s * len(valid) == pytest.approx(strict, abs=0.5)
    assert metrics.acc_r * len(valid) == pytest.approx(relaxed, abs=0.5)
    assert metrics.outliers * len(valid) == pytest.approx(outlying, abs=0.5)
    # Every point has a flow here, so what truly moves is all that was rightly found.
    moves = sum(w > 0.001 for w in ways)
    assert metrics.dynamic_iou * len(valid) == pytest.approx(moves, abs=0.5)
    assert metrics.coverage == metrics.false_flow == 1


def test_points_are_pooled_over_pairs_and_not_averaged_pair_by_pair():
    errors = PooledErrors()
    east, north = np.array([1.0, 0, 0]), np.array([0, 1.0, 0])
    errors.add(flow(np.tile(east, (3, 1))), 1.0, np.tile(east, (3, 1)), None)
    errors.add(flow(np.tile(north, (1, 1))), 1.0, np.tile(east, (1, 1)), None)
    assert errors.metrics().angle_deg == pytest.approx(90 / 4)
    assert np.isnan(errors.metrics().coverage)


def test_a_pair_without_flow_counts_and_nothing_is_defined_by_nothing():
    errors = PooledErrors()
    errors.add(flow(np.array([NONE])), 1.0, np.ones((1, 3)), np.zeros((1, 3)))
    metrics = errors.metrics()
    assert metrics.pairs == 1
    assert metrics.points_with_flow == 0
    assert np.isnan([metrics.angle_deg, metrics.velocity_error, metrics.precision]).all()
    assert np.isnan(metrics.coverage)
    assert metrics.epe3d == 0.0


def test_points_of_unknown_truth_enter_only_the_papers_errors():
    errors = PooledErrors()
    velocity = np.array([[1.0, 0, 0], [1.0, 0, 0]])
    points = np.array([[1.0, 0, 0], NONE])
    errors.add(flow(velocity), 1.0, np.ones((2, 3)), points)
    metrics = errors.metrics()
    assert metrics.points_with_flow == 2
    assert metrics.precision == metrics.coverage == 1.0
    assert metrics.epe3d == 0.0


def test_a_flow_of_zero_has_no_angle():
    errors = PooledErrors()
    errors.add(flow(np.zeros((1, 3))), 1.0, np.ones((1, 3)), None)
    assert np.isnan(errors.metrics().angle_deg)
    assert errors.metrics().velocity_error == pytest.approx(np.sqrt(3))


@given(st.floats(0, np.pi), st.floats(1e-3, 1e3), st.floats(1e-3, 1e3))
def test_angles_do_not_depend_on_lengths(angle: float, a: float, b: float):
    u = np.array([[a, 0.0, 0.0]])
    v = b * np.array([[np.cos(angle), np.sin(angle), 0.0]])
    assert angles_deg(u, v)[0] == pytest.approx(np.degrees(angle), abs=1e-6)


def test_pairs_collected_apart_are_the_same_to_the_last_bit():
    generator = np.random.default_rng(3)
    together, apart = PooledErrors(), PooledErrors()
    for size in (5, 0, 31, 200):
        label = generator.integers(0, 3, size)
        velocity = generator.normal(size=(size, 3))
        velocity[label != Label.MOVING] = np.nan
        found = SceneFlow(label, velocity, np.zeros(size, dtype=np.int64), ())
        truth = generator.normal(size=(size, 3))
        points = generator.normal(size=(size, 3)) * generator.integers(0, 2, (size, 1))
        one = PooledErrors()
        for errors in (together, one):
            errors.add(found, 0.5, truth, points)
        apart.include(one.sums)
    assert apart.metrics() == together.metrics()
    assert apart.metrics().pairs == 4
    assert apart.metrics().points_with_flow > 50
