"""Flow of every pair, in any order: pure methods, and trackers over fixed segments."""

from pathlib import Path

import numpy as np
import pytest

from app.analysis import flows
from app.analysis.estimates import Estimates
from app.analysis.evaluation import EvaluationCase, evaluate, evaluate_all
from app.analysis.pair_estimator import SEGMENT, PairEstimator
from app.analysis.pairs import prepare_pair
from estimator import Method, Parameters, SceneFlow, Window, register, scene_flow_of_points
from recordings import RecordingError, open_recording
from tests.app.fake_recordings import fake_opened, fake_recording
from tests.recordings.room import write_room

N, WARM_UP, FRAMES = 2, 3, 2 * SEGMENT + 30


class Memory:
    """Tracker whose flow says how many steps it has made, and at which stamp it began."""

    def __init__(self, parameters: Parameters) -> None:
        self.steps, self.begin = 0, np.nan

    def step(self, window: Window) -> SceneFlow:
        self.steps += 1
        self.begin = window.stamps[-1] if self.steps == 1 else self.begin
        return scene_flow_of_points(
            np.tile([self.steps, self.begin, 0.0], (len(window.source.points), 1))
        )


@pytest.fixture
def tracked(methods_of_a_test):
    register(Method("memory", tracker=Memory, warm_up=WARM_UP))
    return Parameters(method="memory", n=N)


@pytest.fixture
def recording():
    return fake_recording(frames=FRAMES)


def told(flow: SceneFlow) -> tuple[float, float]:
    """Steps made, and the stamp of the first."""
    return tuple(flow.velocity[0, :2].tolist())


def test_flows_gives_every_pair_in_order(tracked, recording):
    found = dict(flows(recording, tracked))
    assert list(found) == list(range(N, FRAMES))


def test_a_tracker_begins_anew_for_each_segment_its_warm_up_early(tracked, recording):
    found = {k: told(flow) for k, flow in flows(recording, tracked)}
    assert found[N] == (1, recording.stamps[N])
    assert found[N + SEGMENT - 1] == (SEGMENT, recording.stamps[N])
    begin = N + SEGMENT - WARM_UP
    assert found[N + SEGMENT] == (WARM_UP + 1, recording.stamps[begin])


@pytest.mark.parametrize("seed", range(3))
def test_a_frames_flow_does_not_depend_on_earlier_requests(tracked, recording, seed):
    expected = {k: told(flow) for k, flow in flows(recording, tracked)}
    estimator = PairEstimator(tracked)
    for k in np.random.default_rng(seed).permutation(np.arange(N, FRAMES))[:40].tolist():
        pair = estimator.pair(k, lambda k: prepare_pair(recording, k, tracked))
        assert pair.flow is not None
        assert told(pair.flow) == expected[k]


def test_the_page_sees_the_same_flow(tracked, recording):
    opened, estimates = fake_opened(recording), Estimates()
    expected = {k: told(flow) for k, flow in flows(recording, tracked)}
    for k in (FRAMES - 1, N, SEGMENT + 5):
        flow = estimates.estimated(opened, k, tracked).flow
        assert flow is not None
        assert told(flow) == expected[k]


def test_a_frame_that_is_broken_costs_the_others_nothing(tracked):
    recording = fake_recording(frames=40)
    clouds = recording.cloud

    def cloud(k, far):
        if k == 20:
            raise RecordingError("It is broken there.")
        return clouds(k, far)

    recording.cloud = cloud
    estimator = PairEstimator(tracked)

    def prepare(k: int):
        return prepare_pair(recording, k, tracked)

    after = estimator.pair(30, prepare).flow
    assert after is not None
    with pytest.raises(RecordingError, match="broken there"):
        estimator.pair(20, prepare)
    assert told(after)[0] == 30 - N + 1 - 2  # frames 20 and 22 have no window


def test_before_the_start_there_is_no_flow(tracked, recording):
    pair = PairEstimator(tracked).pair(1, lambda k: prepare_pair(recording, k, tracked))
    assert (pair.source, pair.flow) == (None, None)


@pytest.fixture(scope="module")
def room(tmp_path_factory) -> Path:
    return write_room(tmp_path_factory.mktemp("room") / "room.mcap", frames=14).path


def test_flows_are_what_evaluate_pools(room):
    parameters = Parameters()
    with open_recording(room) as recording:
        metrics = evaluate(recording, parameters)
        assert metrics is not None
        counted = sum(
            int(flow.moving.sum())
            for k, flow in flows(recording, parameters)
            if all(np.linalg.norm(recording.truth(j)) > 0.01 for j in (k - parameters.n, k))  # type: ignore[arg-type]
        )
        assert counted == metrics.points_with_flow > 0


def test_methods_asked_together_give_what_each_gives_alone(room):
    cases = [
        EvaluationCase(Parameters(method="baseline")),
        EvaluationCase(Parameters()),
        EvaluationCase(Parameters(n=5), resting=False),
        EvaluationCase(Parameters(delta=0.08)),
        EvaluationCase(Parameters()),
    ]
    with open_recording(room) as recording:
        together = evaluate_all(recording, cases)
        for case, found in zip(cases, together, strict=True):
            alone = evaluate_all(recording, [case])[0]
            assert repr(found.metrics) == repr(alone.metrics)  # nan equals nan


def test_an_error_of_reading_that_passes_costs_a_tracker_nothing(tracked, recording):
    expected = {k: told(flow) for k, flow in flows(recording, tracked)}
    estimator, broken = PairEstimator(tracked), [True]

    def prepare(k: int):
        if k == 20 and broken[0]:
            raise OSError("away")
        return prepare_pair(recording, k, tracked)

    with pytest.raises(OSError, match="away"):
        estimator.pair(30, prepare)
    broken[0] = False
    flow = estimator.pair(30, prepare).flow
    assert flow is not None
    assert told(flow) == expected[30]


def test_a_recording_that_is_opened_again_has_segments_of_its_own(tracked, recording):
    expected = {k: told(flow) for k, flow in flows(recording, tracked)}
    closing, estimates = fake_recording(frames=FRAMES), Estimates(clouds=1, pairs=1, flows=1)
    clouds = closing.cloud

    def cloud(k, far):
        if k > 20:
            raise RecordingError("seek of closed file")
        return clouds(k, far)

    closing.cloud = cloud
    first, again = fake_opened(closing), fake_opened(recording)
    assert first.key == again.key
    with pytest.raises(RecordingError, match="closed file"):
        estimates.estimated_in_background(first, 30, tracked)
    flow = estimates.estimated(again, 30, tracked).flow
    assert flow is not None
    assert told(flow) == expected[30]
