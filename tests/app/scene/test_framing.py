from types import SimpleNamespace
from typing import Any, cast

import numpy as np
import pytest

from app.scene.camera import Camera
from app.scene.framing import Framing
from app.scene.views import ABOVE, SLANTED

SOMEWHERE = Camera((5.0, 6.0, 7.0), (0.0, 0.0, 0.0), 0.7)
PAIR = cast(Any, SimpleNamespace(target=SimpleNamespace(points=np.ones((5, 3)))))
EMPTY = cast(Any, SimpleNamespace(target=SimpleNamespace(points=np.zeros((0, 3)))))


class FakeScene:
    """Puts the camera further away the narrower the picture is."""

    def __init__(self):
        self.taken: list[tuple[str, float]] = []
        self.now = SOMEWHERE

    def place_camera(self, pair, view, aspect):
        self.taken.append((view, aspect))
        self.now = Camera((2.0 / aspect, 0.0, 1.0), (0.0, 0.0, 0.0), 0.7)
        return self.now

    def set_camera(self, camera):
        self.now = camera

    def camera(self):
        return self.now


@pytest.fixture
def scene():
    return FakeScene()


@pytest.fixture
def window():
    return SimpleNamespace(image_width=1200, image_height=800)


@pytest.fixture
def framing(scene, window):
    return Framing(cast(Any, SimpleNamespace(camera=window)), cast(Any, scene))


def test_a_view_is_taken_anew_when_the_picture_gets_narrower(framing, scene, window):
    framing.begin(PAIR)
    framing.adapt_to_window(PAIR)
    assert scene.taken == [(SLANTED, 1.5)]
    window.image_width = 600
    framing.adapt_to_window(PAIR)
    assert scene.taken == [(SLANTED, 1.5), (SLANTED, 0.75)]
    framing.set_view(PAIR, ABOVE)
    window.image_width = 1200
    framing.adapt_to_window(PAIR)
    assert scene.taken[-2:] == [(ABOVE, 0.75), (ABOVE, 1.5)]


def test_where_there_was_nothing_to_see_the_first_view_waits_for_something(framing, scene):
    framing.begin(EMPTY)
    framing.retry_first_view(EMPTY)
    assert len(scene.taken) == 1
    framing.retry_first_view(PAIR)
    framing.retry_first_view(PAIR)
    assert len(scene.taken) == 2


def test_a_camera_that_a_person_has_moved_stays(framing, scene, window):
    framing.begin(PAIR)
    scene.now = SOMEWHERE
    window.image_width = 600
    framing.adapt_to_window(PAIR)
    assert scene.now == SOMEWHERE


def test_where_it_is_told_to_stand_it_stays_and_the_next_recording_begins_anew(
    framing, scene, window
):
    framing.start_from(SOMEWHERE)
    framing.begin(PAIR)
    window.image_width = 600
    framing.adapt_to_window(PAIR)
    assert scene.now == SOMEWHERE
    assert scene.taken == []
    framing.begin(PAIR)
    np.testing.assert_allclose(scene.now.position, (2.0 / 0.75, 0.0, 1.0))


def test_a_view_of_a_turned_sensor_is_turned_and_the_next_view_upright(framing, scene, window):
    framing.begin(PAIR)
    framing.look(SOMEWHERE, up=(0.0, 1.0, 0.0))
    assert (scene.now, window.up_direction) == (SOMEWHERE, (0.0, 1.0, 0.0))
    window.image_width = 600
    framing.adapt_to_window(PAIR)  # it is no named view
    assert scene.now == SOMEWHERE
    framing.set_view(PAIR, "Top")
    assert window.up_direction == (0.0, 0.0, 1.0)
