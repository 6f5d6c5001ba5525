"""The two engines, and the choice between them."""

from dataclasses import replace

import numpy as np
import pytest

from estimator import (
    ENGINES,
    Engine,
    Parameters,
    current_engine,
    estimate,
    estimate_scene_flow,
    window_of_pair,
)
from estimator.engines import COMPILED, REFERENCE, use_engine, warm_up
from estimator.icp import align
from recordings import open_recording, sample_paths
from tests.estimator.engines import AS_SCIKIT_LEARN, using
from tests.estimator.scenes import cluttered


def test_the_compiled_one_is_used_unless_another_is_chosen():
    assert current_engine() is COMPILED
    assert ENGINES == {"compiled": COMPILED, "reference": REFERENCE}
    use_engine(REFERENCE)
    try:
        assert current_engine() is REFERENCE
    finally:
        use_engine(COMPILED)


@pytest.mark.parametrize("method", ["paper", "baseline"])
@pytest.mark.parametrize("path", sample_paths(), ids=lambda path: path.stem)
def test_both_estimate_the_same_of_a_pair_of_the_samples(path, method):
    with open_recording(path) as recording:
        k = len(recording) // 2
        interval = float(recording.stamps[k] - recording.stamps[k - 8])
        window = window_of_pair(recording.cloud(k - 8), recording.cloud(k), interval)
    flows = []
    for engine in (REFERENCE, AS_SCIKIT_LEARN):
        with using(engine):
            flows.append(estimate(window, Parameters(method=method)))
    assert flows[1].label.tolist() == flows[0].label.tolist()
    assert flows[1].velocity == pytest.approx(flows[0].velocity, abs=1e-8, nan_ok=True)


def counted(engine: Engine) -> tuple[Engine, list[str]]:
    """An engine, and the steps that it is asked for."""
    steps: list[str] = []

    def labels(*arguments):
        steps.append("labels")
        return engine.labels(*arguments)

    def align_counted(*arguments):
        steps.append("align")
        return engine.align(*arguments)

    return replace(engine, labels=labels, align=align_counted), steps


def test_only_the_chosen_one_estimates():
    scene = cluttered(0)
    chosen, steps = counted(REFERENCE)
    with using(chosen):
        estimate_scene_flow(scene.source, scene.target, 0.5, Parameters())
    assert set(steps) == {"labels", "align"}


@pytest.mark.parametrize("engine", ENGINES.values(), ids=ENGINES)
def test_warming_up_runs_both_steps(engine):
    warmed, steps = counted(engine)
    warm_up(warmed)
    assert steps == ["align", "labels"]


def test_warming_up_runs_all_that_is_compiled(monkeypatch):
    """Where the compiled ICP has no answer, Open3D's is taken, and compiles nothing."""
    asked = []
    monkeypatch.setattr("estimator.engines.align_with_open3d", lambda *a: asked.append(a))
    warm_up(COMPILED)
    assert asked == []


def test_where_points_are_equally_near_the_registration_is_open3ds():
    rng = np.random.default_rng(0)
    source = rng.normal(size=(50, 3)).round(1)
    twice = np.vstack([source, source])
    found, expected = COMPILED.align(source, twice, 0.1), align(source, twice, 0.1)
    assert found.inlier_target.tolist() == expected.inlier_target.tolist()
    assert found.transformation.tolist() == expected.transformation.tolist()


@pytest.mark.parametrize("engine", ENGINES.values(), ids=ENGINES)
def test_labels_are_whole_numbers_from_zero_and_minus_one(engine):
    rng = np.random.default_rng(0)
    islands = np.vstack([rng.normal(size=(40, 3)) * 0.02 + 3.0 * part for part in range(2)])
    cloud = np.vstack([islands, [[40.0, 0.0, 0.0]]])
    found = engine.labels(cloud, 10, None, False)
    assert found.dtype == np.int64
    assert found[-1] == -1
    assert set(found[:40].tolist()) - {-1} != set(found[40:80].tolist()) - {-1}
    assert set(found.tolist()) == {-1, 0, 1}
