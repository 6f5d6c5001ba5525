"""What a person looks at is followed from frame to frame."""

from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from app.analysis.estimates import Estimates
from app.analysis.zones import SOURCE, TARGET, Zone
from app.errors import InputError
from app.scene.pointer_view import POINTS_NODE, SELECTED_NODE, PointerView
from app.scene.scene import Scene
from app.scene.settings import HIDDEN, LAYERS, ViewSettings
from app.session.inspection import Inspection, drawn_points
from estimator import Parameters
from tests.app.fake_recordings import fake_opened

SETTINGS = ViewSettings()
OPENED = fake_opened()
ESTIMATES = Estimates()


def pair(k: int = 20) -> Any:
    return ESTIMATES.estimated(OPENED, k, Parameters())


class Eye:
    """A camera far away, and an inspection that follows a frame."""

    def __init__(self, client):
        scene = Scene(client, SETTINGS)
        scene.open(OPENED.recording)
        self.inspection = Inspection(PointerView(client), scene)
        self.follow()

    def follow(self, k: int = 20, **settings):
        self.inspection.follow(OPENED, pair(k), 4.0, replace(SETTINGS, **settings))
        return self.inspection.inspected

    def ray(self, point):
        origin = np.array([0.3, -3.0, 1.0])
        return tuple(origin), tuple(np.asarray(point) - origin)


@pytest.fixture
def eye(client) -> Eye:
    return Eye(client)


def test_a_pinned_point_is_followed_by_its_zone(eye, client):
    point = pair().source.points[450]
    cluster = eye.inspection.pin_along(*eye.ray(point))
    assert cluster == pair().flow.cluster[450]
    found = eye.follow()
    assert found.pinned.point.position == tuple(point)
    assert found.selected == 0
    np.testing.assert_allclose(client.node(POINTS_NODE).points, [point], atol=1e-6)
    assert client.node(SELECTED_NODE).visible
    later = eye.follow(25)
    assert later.pinned.point.position == tuple(pair(25).source.points[450])
    assert later.pinned.frame == 17


def test_pointing_leaves_what_is_pinned_alone_and_goes_with_the_pointer(eye):
    eye.inspection.pin(Zone(TARGET, 0, 0, 3))
    eye.inspection.point_along(*eye.ray(pair().target.points[450]))
    found = eye.follow()
    assert found.pinned.zone == Zone(TARGET, 0, 0, 3)
    assert found.pointed.zone.column == 450 % 25
    eye.inspection.point(None)
    assert eye.follow().pointed is None
    assert eye.follow().pinned is not None


def test_a_click_beside_everything_lets_go(eye):
    eye.inspection.pin(Zone(TARGET, 0, 0, 3))
    assert eye.inspection.pin_along((0.0, 0.0, 9.0), (0.0, 0.0, 1.0)) is None
    found = eye.follow()
    assert (found.pinned, found.selected) == (None, None)


def test_a_frustum_answers_and_a_click_selects_its_sensor(eye):
    # The sensor looks along z from (0.2, 0, 0).
    ray = (0.2, -1.0, 0.06), (0.0, 1.0, 0.0)
    eye.inspection.point_along(*ray)
    assert eye.follow().pointed_sensor == 0
    eye.inspection.pin_along(*ray)
    assert eye.follow().selected == 0
    assert eye.follow().pinned is None
    hidden = frozenset(LAYERS) - {"Sensors", "Frustums"}
    eye.follow(layers=hidden)
    eye.inspection.point_along(*ray)
    assert eye.follow(layers=hidden).pointed_sensor is None


def test_zones_and_sensors_that_there_are_not_are_ignored(eye):
    eye.inspection.point(Zone(TARGET, 7, 0, 0))
    eye.inspection.pin(Zone(TARGET, 0, 99, 0))
    eye.inspection.select(5)
    found = eye.follow()
    assert (found.pointed, found.pinned, found.selected) == (None, None, None)


def test_another_recording_lets_go_of_everything(eye):
    eye.inspection.pin(Zone(TARGET, 0, 0, 3))
    other = fake_opened()
    eye.inspection.follow(other, ESTIMATES.estimated(other, 20, Parameters()), 4.0, SETTINGS)
    found = eye.inspection.inspected
    assert (found.pinned, found.selected) == (None, None)


def test_a_reload_comes_back_to_the_pinned_zone_and_the_selected_sensor(eye):
    eye.inspection.start_from(0, Zone(TARGET, 0, 0, 3))
    other = fake_opened()
    eye.inspection.follow(other, ESTIMATES.estimated(other, 20, Parameters()), 4.0, SETTINGS)
    assert eye.inspection.pinned == Zone(TARGET, 0, 0, 3)
    assert eye.inspection.inspected.selected == 0
    eye.inspection.start_from(10**5, Zone(TARGET, 0, 900, 3))
    again = fake_opened()
    eye.inspection.follow(again, ESTIMATES.estimated(again, 20, Parameters()), 4.0, SETTINGS)
    assert eye.inspection.pinned is None
    assert eye.inspection.inspected.selected is None


def test_nothing_can_be_looked_from_without_a_selected_sensor(eye):
    with pytest.raises(InputError, match="Select a sensor first"):
        eye.inspection.look_from_selected(None)


def test_only_points_that_are_drawn_answer():
    assert set(drawn_points(pair(), SETTINGS)) == {SOURCE, TARGET}
    without = replace(SETTINGS, layers=frozenset({"Target"}), static_scene=HIDDEN)
    drawn = drawn_points(pair(), without)
    assert set(drawn) == {TARGET}
    assert drawn[TARGET].shown.sum() == 100
    assert drawn_points(pair(), SETTINGS)[SOURCE].clear.sum() == 100
