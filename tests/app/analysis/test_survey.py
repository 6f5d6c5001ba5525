from dataclasses import astuple, replace

import numpy as np
import pytest

from app.analysis.estimates import Estimates
from app.analysis.evaluation import EvaluationCase, evaluate, evaluate_all
from app.analysis.quantities import QUANTITIES
from app.analysis.survey import Survey, valid_share
from estimator import Parameters
from recordings import PairTruth, RecordingError, open_recording
from tests.app.fake_recordings import FRAMES, PERIOD, fake_opened, fake_recording
from tests.recordings.room import write_room


def filled(opened, parameters, estimates=None):
    estimates = estimates or Estimates()
    survey = Survey(opened.recording, parameters)
    for k in np.flatnonzero(~survey.done).tolist():
        survey.put(k, estimates.estimated(opened, k, parameters))
    return survey


def test_every_frame_of_a_patch_that_moves():
    survey = filled(fake_opened(), Parameters())
    assert survey.complete
    for values in (
        survey.moving,
        survey.speed,
        survey.metrics["angle_deg"],
        survey.metrics["coverage"],
    ):
        assert np.isnan(values[:8]).all()
    assert (survey.moving[8:] == 100).all()
    np.testing.assert_allclose(survey.speed[8:], 0.15, atol=1e-3)
    np.testing.assert_allclose(survey.true_speed[8:], 0.15)
    np.testing.assert_allclose(survey.metrics["angle_deg"][8:], 0, atol=0.1)
    np.testing.assert_allclose(survey.metrics["velocity_error"][8:], 0, atol=1e-3)
    assert (survey.metrics["coverage"][8:] == 1).all()
    assert (survey.metrics["precision"][8:] == 1).all()


@pytest.mark.parametrize("parameters", [Parameters(), Parameters(n=5, gamma=0.6)])
def test_the_summary_is_what_evaluate_says_to_the_last_bit(parameters, tmp_path):
    path = write_room(tmp_path / "room.mcap", frames=16).path
    with open_recording(path) as recording:
        survey = filled(fake_opened(recording), parameters)
        assert survey.summary() == evaluate(recording, parameters)
        assert survey.summary().points_with_flow > 100


def test_the_share_of_zones_with_a_range_is_known_of_both_frames():
    fake = fake_recording()
    clouds = fake.cloud

    def cloud(k, far=4.0):
        seen = clouds(k, far)
        ranges = np.full(seen.ranges.shape, np.nan)
        ranges.reshape(-1)[: k % 8 * ranges.size // 8] = 1.0
        return replace(seen, ranges=ranges)

    fake.cloud = cloud
    survey = Survey(fake, Parameters())
    assert np.isnan(survey.valid).all()
    survey.put(21, Estimates().estimated(fake_opened(fake), 21, Parameters()))
    assert np.flatnonzero(np.isfinite(survey.valid)).tolist() == [13, 21]
    np.testing.assert_allclose(survey.valid[[13, 21]], 5 / 8, atol=0.002)
    np.testing.assert_allclose(
        filled(fake_opened(fake), Parameters()).valid, np.arange(FRAMES) % 8 / 8, atol=0.002
    )


def test_zones_that_the_sensor_does_not_have_are_not_counted():
    seen = fake_recording().cloud(3)
    directions = seen.directions.copy()
    directions[:, :, 4:] = np.nan
    ranges = np.where(np.isfinite(directions[..., 0]), 1.0, np.nan)
    ranges[:, 0] = np.nan
    rows = ranges.shape[1]
    share = valid_share(replace(seen, directions=directions, ranges=ranges))
    assert share == pytest.approx((rows - 1) / rows)
    nothing = replace(seen, directions=np.nan * directions, ranges=np.nan * ranges)
    assert np.isnan(valid_share(nothing))


def test_no_flow_leaves_gaps_and_no_coverage():
    survey = filled(fake_opened(), Parameters(delta=0.5))
    assert (survey.moving[8:] == 0).all()
    assert np.isnan(survey.speed).all()
    assert np.isnan(survey.metrics["angle_deg"]).all()
    assert np.isnan(survey.metrics["precision"]).all()
    assert (survey.metrics["coverage"][8:] == 0).all()


def test_pairs_that_do_not_count_have_the_errors_of_their_own_and_are_not_in_the_means():
    fake = fake_recording()
    fake.truth = lambda k: np.zeros(3) if k < 20 else np.array([0.0, 0.15, 0.0])
    opened, estimates = fake_opened(fake), Estimates()
    survey = filled(opened, Parameters(), estimates)
    assert not survey.counts[:28].any()
    assert survey.counts[28:].all()
    # As Status says for the frame: the object moves during the pair.
    errors = estimates.estimated(opened, 15, Parameters()).errors
    assert errors is not None
    assert survey.metrics["angle_deg"][15] == errors.angle_deg
    assert survey.metrics["velocity_error"][15] == errors.velocity_error
    assert np.isfinite(survey.speed[8:]).all()
    assert survey.summary() == evaluate(fake, Parameters())
    assert survey.summary().pairs == FRAMES - 28
    assert survey.pairs == FRAMES - 8


def test_every_quantity_has_a_value_of_every_pair():
    opened = fake_opened()
    survey = filled(opened, Parameters())
    values = {name: q.values(opened.recording, survey)[20] for name, q in QUANTITIES.items()}
    assert values["points"] == 500 == values["moving"] + values["stationary"] + values["unassigned"]
    assert values["clusters"] == 5
    assert values["interval"] == pytest.approx(8 * PERIOD)
    assert values["time"] == pytest.approx(20 * PERIOD)
    assert np.isfinite(list(values.values())).all()


def test_where_nothing_ever_moves_the_false_flow_is_known_alone():
    fake = fake_recording()
    fake.truth = lambda _: np.zeros(3)
    fake.pair_truth = lambda *_: PairTruth(np.zeros((500, 3)), np.zeros((500, 3)))
    survey = filled(fake_opened(fake), Parameters())
    metrics = evaluate(fake, Parameters())
    assert metrics is not None
    assert astuple(survey.summary()) == pytest.approx(astuple(metrics), nan_ok=True)
    assert metrics.pairs == 0
    assert metrics.false_flow == 100 / 500
    assert np.isnan([metrics.angle_deg, metrics.epe3d, metrics.dynamic_iou]).all()


def test_pairs_that_do_not_count_can_be_left_out():
    fake = fake_recording()
    fake.truth = lambda k: np.zeros(3) if k < 30 else np.array([0.0, 0.15, 0.0])
    asked = []
    clouds = fake.cloud
    fake.cloud = lambda k, far: asked.append(k) or clouds(k, far)
    metrics = evaluate_all(fake, [EvaluationCase(Parameters(), resting=False)])[0].metrics
    assert sorted(asked) == [*range(30, 32), *range(38, 40)]
    whole = evaluate(fake, Parameters())
    assert metrics is not None
    assert whole is not None
    assert np.isnan(metrics.false_flow)
    assert whole.false_flow == 0
    assert replace(metrics, false_flow=0.0) == whole


@pytest.mark.parametrize(("broken", "counts"), [(3, False), (33, True)])
def test_a_broken_frame_costs_the_errors_only_where_the_object_moves(broken: int, counts: bool):
    fake = fake_recording()
    fake.truth = lambda k: np.zeros(3) if k < 20 else np.array([0.0, 0.15, 0.0])
    whole = evaluate(fake, Parameters())
    clouds = fake.cloud

    def cloud(k, far):
        if k == broken:
            raise RecordingError("It is broken there.")
        return clouds(k, far)

    fake.cloud = cloud
    if counts:
        with pytest.raises(RecordingError):
            evaluate(fake, Parameters())
    else:
        assert evaluate(fake, Parameters()) == whole


def test_an_object_at_rest_has_a_true_speed_of_zero():
    fake = fake_recording()
    fake.pair_truth = lambda *_: PairTruth(np.zeros((500, 3)), np.zeros((500, 3)))
    assert (filled(fake_opened(fake), Parameters()).true_speed[8:] == 0).all()


def test_without_truth_there_is_a_flow_alone():
    fake = fake_recording()
    fake.truth = lambda _: None
    fake.pair_truth = lambda *_: None
    survey = filled(fake_opened(fake), Parameters())
    assert (survey.moving[8:] == 100).all()
    assert np.isnan(survey.true_speed).all()
    assert np.isnan(survey.metrics["coverage"]).all()
    assert survey.summary().pairs == 0


def test_a_broken_frame_is_done_and_empty():
    survey = Survey(fake_recording(), Parameters())
    survey.put(20, None)
    assert survey.done[20]
    assert np.isnan(survey.moving[20])
    assert not survey.done[21]
