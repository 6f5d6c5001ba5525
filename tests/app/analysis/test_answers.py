"""What is said of a point, for a patch that moves at a known velocity."""

from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from app.analysis.answers import answer
from app.analysis.estimates import Estimates
from app.analysis.zones import SOURCE, TARGET, Zone, ZoneState, zone_of_point
from estimator import Label, Parameters
from tests.app.fake_recordings import SPEED, fake_opened

OPENED = fake_opened()
RESTING, MOVING = 5, 450  # indices of points


@pytest.fixture(scope="module")
def pair():
    return Estimates().estimated(OPENED, 20, Parameters())


def asked(pair, side, index) -> Any:
    return answer(OPENED.recording, pair, zone_of_point(pair, side, index), 4.0)


def test_a_moving_source_point_has_a_velocity_and_a_small_error(pair):
    found = asked(pair, SOURCE, MOVING)
    assert (found.frame, found.sensor, found.state) == (12, "front", ZoneState.POINT)
    assert found.along_axis == 1.0
    assert found.along_ray > 1.0
    assert found.lateness == 0.0
    point = found.point
    assert point.position == tuple(pair.source.points[MOVING])
    assert point.label is Label.MOVING
    assert point.truth == pytest.approx(SPEED)
    assert point.velocity == pytest.approx(SPEED, abs=0.02)
    assert point.error == pytest.approx(np.linalg.norm(np.subtract(point.velocity, SPEED)))
    assert point.cluster == pair.flow.cluster[MOVING]


def test_a_resting_point_has_none(pair):
    point = asked(pair, SOURCE, RESTING).point
    assert (point.label, point.velocity, point.error) == (Label.STATIONARY, None, None)
    assert point.truth == (0.0, 0.0, 0.0)
    assert not point.truly_moves


def test_a_target_point_has_the_velocity_of_its_moving_cluster(pair):
    found = asked(pair, TARGET, MOVING)
    assert found.frame == 20
    assert found.point.label is Label.MOVING
    assert found.point.cluster_velocity == pytest.approx(SPEED, abs=0.02)
    assert (found.point.velocity, found.point.error) == (None, None)
    assert found.point.truth == pytest.approx(SPEED)
    resting = asked(pair, TARGET, RESTING).point
    assert (resting.label, resting.cluster_velocity) == (None, None)
    assert resting.cluster is not None


def test_without_an_estimate_or_a_source_less_is_known(pair):
    bare = replace(pair, flow=None)
    assert asked(bare, SOURCE, MOVING).point.label is None
    assert asked(bare, TARGET, MOVING).point.label is None
    alone = replace(pair, source=None, flow=None)
    assert answer(OPENED.recording, alone, Zone(SOURCE, 0, 0, 0), 4.0) is None


def test_the_ray_leads_from_the_sensor_along_the_zone(pair):
    found = asked(pair, TARGET, RESTING)
    pose = pair.target.T_fixed_sensor[0]
    assert found.origin == tuple(pose[:3, 3])
    np.testing.assert_allclose(found.direction, pair.target.directions[0, 0, RESTING])
