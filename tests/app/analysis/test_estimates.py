import subprocess
import sys
import threading

import numpy as np
import pytest

import app.analysis.estimates
import app.analysis.pair_estimator
from app.analysis.estimates import Estimates
from estimator import Label, Parameters
from tests.app.fake_recordings import PERIOD, SPEED, fake_opened, fake_recording
from tests.app.waiting import until
from tests.estimator.engines import Counting, using

MOVING = 100  # points of the moving patch, the last of the cloud


@pytest.fixture
def counted(monkeypatch):
    """Arguments of every run of the estimator."""
    runs = []
    real = app.analysis.pair_estimator.estimate

    def count(*arguments):
        runs.append(arguments)
        return real(*arguments)

    monkeypatch.setattr(app.analysis.pair_estimator, "estimate", count)
    return runs


def test_the_moving_patch_gets_its_velocity():
    pair = Estimates().estimated(fake_opened(), 20, Parameters())
    assert pair.flow is not None
    assert pair.interval == pytest.approx(8 * PERIOD)
    assert (pair.flow.label[-MOVING:] == Label.MOVING).all()
    assert (pair.flow.label[:-MOVING] == Label.STATIONARY).all()
    np.testing.assert_allclose(pair.flow.velocity[-MOVING:], np.tile(SPEED, (MOVING, 1)), atol=1e-3)
    assert pair.milliseconds > 0
    assert pair.errors is not None
    assert pair.errors.angle_deg == pytest.approx(0, abs=0.1)
    assert pair.errors.coverage == 1
    assert pair.object_velocity == pytest.approx(SPEED)


def test_before_the_start_there_is_no_source_and_no_estimate(counted):
    pair = Estimates().estimated(fake_opened(), 7, Parameters(n=8))
    assert pair.source is None
    assert pair.flow is None
    assert pair.errors is None
    assert len(pair.target.points) == 500
    assert counted == []


def test_the_same_question_is_answered_from_memory(counted):
    estimates, opened = Estimates(), fake_opened()
    first = estimates.estimated(opened, 20, Parameters())
    assert estimates.estimated(opened, 20, Parameters()) is first
    assert len(counted) == 1
    assert not first.reused
    assert estimates.estimated(opened, 20, Parameters(delta=0.05)).reused
    assert len(counted) == 2
    assert not estimates.estimated(opened, 21, Parameters(delta=0.05)).reused


def test_clouds_are_shared_by_pairs_and_by_parameters():
    estimates, opened = Estimates(), fake_opened()
    a = estimates.estimated(opened, 20, Parameters(n=8))
    b = estimates.estimated(opened, 20, Parameters(n=5))
    c = estimates.estimated(opened, 12, Parameters(n=5))
    assert b.target is a.target
    assert b.source is not a.source
    assert c.target is a.source


def test_memory_is_bounded(counted):
    estimates, opened = Estimates(clouds=4, flows=2), fake_opened()
    for k in (20, 21, 22, 20):
        estimates.estimated(opened, k, Parameters())
    assert len(counted) == 4


def test_a_resting_object_has_no_velocity_and_no_errors():
    fake = fake_recording()
    fake.pair_truth = lambda *_: type(fake_recording().pair_truth(0, 8))(
        np.zeros((500, 3)), np.zeros((500, 3))
    )
    pair = Estimates().estimated(fake_opened(fake), 20, Parameters())
    assert pair.truth is not None
    assert pair.object_velocity is None
    assert pair.errors is None


def test_without_truth_there_are_no_errors():
    fake = fake_recording()
    fake.pair_truth = lambda *_: None
    pair = Estimates().estimated(fake_opened(fake), 20, Parameters())
    assert pair.errors is None
    assert pair.object_velocity is None
    assert pair.truly_moving.all()


def test_warming_up_loads_what_an_estimate_needs():
    code = (
        "import sys; from app.analysis.estimates import warm_up; warm_up();"
        "sys.exit(not {'open3d', 'sklearn.cluster'} <= set(sys.modules))"
    )
    assert subprocess.run([sys.executable, "-c", code], check=False).returncode == 0


def test_other_thresholds_neither_read_nor_cluster_nor_register_again():
    read, counting = [], Counting()
    fake = fake_recording()
    for name in ("cloud", "pair_truth", "link_poses"):
        real = getattr(fake, name)
        setattr(fake, name, lambda *a, real=real: read.append(a) or real(*a))
    estimates, opened = Estimates(), fake_opened(fake)
    with using(counting.engine()):
        estimates.estimated(opened, 20, Parameters(delta=0.05))
        ran = len(counting.clusterings), len(counting.icps)
        assert read
        assert min(ran) > 0
        read.clear()
        for parameters in (Parameters(delta=0.01), Parameters(gamma=0.3), Parameters(n_min=90)):
            pair = estimates.estimated(opened, 20, parameters)
            assert pair.anything_moves
        assert estimates.estimated(opened, 20, Parameters(delta=1.0)).anything_moves is False
    assert read == []
    assert (len(counting.clusterings), len(counting.icps)) == ran


def test_what_is_remembered_of_pairs_is_bounded():
    counting = Counting()
    estimates, opened = Estimates(pairs=2), fake_opened()
    with using(counting.engine()):
        for k, delta in ((20, 0.01), (21, 0.01), (22, 0.01), (22, 0.02), (20, 0.02)):
            estimates.estimated(opened, k, Parameters(delta=delta))
    assert len(counting.clusterings) == 4


def test_of_large_clouds_fewer_are_cached(monkeypatch):
    monkeypatch.setattr(app.analysis.estimates, "_MOST_POINTS", 5 * 500)
    estimates, opened = Estimates(), fake_opened()
    for k in range(10, 20):
        estimates.estimated(opened, k, Parameters())
    frames = [pair.frame for pair in estimates.cached(opened, Parameters())]
    assert frames == [15, 16, 17, 18, 19]
    assert len(estimates._clouds) == len(estimates._prepared) == 5


def test_the_background_begins_no_cloud_while_a_person_waits(monkeypatch):
    monkeypatch.setattr(app.analysis.estimates, "_PATIENCE", 3600.0)
    recording, loaded, go_on = fake_recording(), [], threading.Event()
    cloud = recording.cloud

    def load(k, max_range=4.0):
        loaded.append(k)
        if k == 30:
            assert go_on.wait(10)
        return cloud(k, max_range)

    recording.cloud = load
    estimates, opened = Estimates(), fake_opened(recording)
    waiting = threading.Thread(target=lambda: estimates.estimated(opened, 30, Parameters()))
    waiting.start()
    until(lambda: 30 in loaded)
    background = threading.Thread(
        target=lambda: estimates.estimated_in_background(opened, 20, Parameters())
    )
    background.start()
    background.join(0.2)
    assert loaded == [30]
    go_on.set()
    background.join(10)
    waiting.join(10)
    assert sorted(loaded) == [12, 20, 22, 30]
    assert estimates.known(opened, 20, Parameters()) is not None


def test_the_background_goes_on_beside_a_person_who_never_pauses(monkeypatch):
    monkeypatch.setattr(app.analysis.estimates, "_PATIENCE", 0.05)
    estimates, opened = Estimates(), fake_opened()
    with estimates.foreground:
        assert estimates.estimated_in_background(opened, 20, Parameters()).flow is not None
        assert estimates.estimated_in_background(opened, 3, Parameters()).flow is None
