from typing import Any

import numpy as np
import pytest

from app.scene.floor import GRID, Floor, foot_of
from app.scene.palettes import PAPER, palette
from app.scene.scene import Scene
from app.scene.settings import TRANSPARENT, ViewSettings
from robot_assets import load_robot
from tests.app.fake_recordings import fake_opened, fake_recording
from tests.app.fake_session import snapshot

SHADOW = f"{GRID}/shadow"
BASE = np.array([[-0.1, -0.2, 0.0], [0.3, 0.2, 0.0], [0.0, 0.0, 0.5], [2.0, 0.0, 0.6]])


def at(x, y, z, R=None):
    pose = np.eye(4)
    pose[:3, :3] = np.eye(3) if R is None else R
    pose[:3, 3] = x, y, z
    return pose


def test_a_robot_stands_on_the_lowest_part_of_its_base():
    foot: Any = foot_of(BASE, at(1.0, 2.0, 0.7))
    np.testing.assert_allclose(foot.centre, [1.1, 2.0, 0.7])
    np.testing.assert_allclose(foot.size, [0.4, 0.4])


def test_a_tilted_base_stands_on_nothing():
    lying = np.array([[1.0, 0, 0], [0, 0, -1], [0, 1, 0]])
    assert foot_of(BASE, at(0, 0, 0, lying)) is None
    assert foot_of(BASE, np.full((4, 4), np.nan)) is None
    assert foot_of(BASE[:0], np.eye(4)) is None


@pytest.fixture
def floor(client):
    return Floor(client.scene, palette(PAPER, dark=False))


def test_the_plane_and_the_shadow_are_there_with_a_robot_alone(floor, client):
    assert client.node(GRID).plane_opacity == 0
    assert not client.node(SHADOW).visible
    floor.stand(foot_of(BASE, at(1.0, 2.0, 0.7)))
    assert client.node(GRID).plane_opacity > 0
    assert client.node(SHADOW).visible
    np.testing.assert_allclose(client.node(GRID).position, [1.1, 2.0, 0.7])
    floor.make_solid(False)
    assert client.node(GRID).plane_opacity == 0
    assert client.node(SHADOW).visible


def test_the_plane_covers_nothing_that_moves(floor, client):
    foot: Any = foot_of(BASE, at(1.0, 2.0, 0.7))
    floor.stand(foot)
    floor.show(np.array([[0.0, 0.0, 0.8]]))
    assert client.node(GRID).plane_opacity > 0
    floor.show(np.array([[0.0, 0.0, 0.5]]))
    assert client.node(GRID).plane_opacity == 0
    floor.show(np.array([[0.0, 0.0, 0.8]]))
    assert client.node(GRID).plane_opacity == 0  # it does not come and go
    floor.stand(foot)
    assert client.node(GRID).plane_opacity > 0


def test_it_stands_aside_where_the_recording_does_not_say_where_up_is(floor, client):
    floor.know_up(False)
    assert not client.node(GRID).visible
    floor.want(True)
    assert not client.node(GRID).visible
    floor.know_up(True)
    assert client.node(GRID).visible


def test_its_lines_suit_the_distance(floor, client):
    floor.fit(2.0)
    near = client.node(GRID).cell_size
    floor.fit(30.0)
    assert client.node(GRID).cell_size > near
    assert client.node(GRID).fade_distance > 30


def test_in_an_optical_frame_there_is_none(client):
    recording = fake_recording()
    recording.fixed_frame = "tof_front_optical_frame"
    scene = Scene(client, ViewSettings())
    scene.open(recording)
    assert not client.node(GRID).visible
    scene.open(fake_recording())
    assert client.node(GRID).visible


def test_in_a_transparent_picture_lies_no_slab(client):
    scene = Scene(client, ViewSettings())
    recording = fake_recording(robot=load_robot())
    scene.open(recording)
    shown: Any = snapshot(opened=fake_opened(recording))
    scene.show(shown.pair)
    assert client.node(GRID).plane_opacity > 0
    scene.change(ViewSettings(behind=TRANSPARENT))
    assert client.node(GRID).plane_opacity == 0
