import numpy as np
import pytest

from app.analysis.estimates import Estimates
from app.scene.camera import Camera
from app.scene.depth import Depth, Extent, extent_of
from app.scene.drawn_flow import moving_ends
from estimator import Parameters
from tests.app.fake_recordings import fake_opened

WHITE = (255, 255, 255)
NEAR = Extent(np.zeros(3), 1.0, 3.0)


class FakeScene:
    def __init__(self):
        self.fogs = []

    def configure_fog(self, near, far, color, enabled):
        self.fogs.append((near, far, color, enabled))


@pytest.fixture
def scene():
    return FakeScene()


@pytest.fixture
def depth(scene):
    depth = Depth(scene)
    depth.show(NEAR)
    return depth


def camera(x, y=0.0, look_at=(0.0, 0.0, 0.0)):
    return Camera((x, y, 0.0), look_at, 0.7)


def test_what_moves_and_the_sensors_are_near():
    pair = Estimates().estimated(fake_opened(), 20, Parameters())
    extent = extent_of(pair, np.eye(3))
    assert extent is not None
    near = np.vstack([pair.target.T_fixed_sensor[:, :3, 3], *moving_ends(pair)])
    assert (np.linalg.norm(near - extent.centre, axis=1) <= extent.radius + 1e-9).all()
    assert extent.reach > extent.radius


@pytest.mark.parametrize("look_at", [(0.0, 0.0, 0.0), (0.5, -0.5, 0.0)])
def test_nothing_near_is_faded_however_the_camera_turns(depth, scene, look_at):
    depth.fit(camera(4.0, look_at=look_at))
    near, far, _, _ = scene.fogs[-1]
    # From any direction at that distance.
    away = np.linalg.norm(np.subtract((4.0, 0.0, 0.0), look_at))
    assert near >= away + np.linalg.norm(look_at) + NEAR.radius - 1e-9
    assert far > away + NEAR.reach


def test_a_camera_that_turns_sends_nothing(depth, scene):
    depth.fit(camera(4.0))
    depth.fit(camera(0.0, 4.0))
    assert len(scene.fogs) == 1
    depth.fit(camera(5.0))
    assert len(scene.fogs) == 2


def test_it_fades_into_the_background_or_not_at_all(depth, scene):
    depth.paint(WHITE, wanted=True)
    depth.fit(camera(4.0))
    assert scene.fogs[-1][2:] == (WHITE, True)
    depth.paint(WHITE, wanted=False)
    depth.fit(camera(4.0))
    assert scene.fogs[-1][3] is False


def test_where_nothing_is_known_nothing_fades(depth, scene):
    depth.show(None)
    depth.fit(camera(4.0))
    assert scene.fogs[-1][3] is False
