from typing import Any

import numpy as np
import pytest

from app.scene.camera import Camera
from app.scene.scale_bar import scale_bar

AS_HIGH_AS_FAR = 2 * np.arctan(0.5)
"""Field of view whose picture is as high as its look-at point is distant."""


def camera(distance, fov=AS_HIGH_AS_FAR):
    return Camera((0.0, -distance, 0.0), (0.0, 0.0, 0.0), fov)


def test_its_length_is_that_at_the_look_at_point():
    # At 4 m the picture is 4 m high and 8 m wide: a quarter of that is the bar.
    bar: Any = scale_bar(camera(4.0), 800, 400)
    assert (bar.metres, bar.pixels) == (2.0, pytest.approx(200))


@pytest.mark.parametrize("distance", np.geomspace(1e-3, 1e3, 40))
def test_it_is_round_and_never_longer_than_a_quarter_of_the_width(distance):
    bar: Any = scale_bar(camera(distance, fov=0.66), 1280, 720)
    assert 1280 / 4 / 2.51 < bar.pixels <= 1280 / 4 * (1 + 1e-6)
    digits = f"{bar.metres:.3e}"
    assert digits[:5] in ("1.000", "2.000", "5.000")


@pytest.mark.parametrize(
    ("distance", "text"), [(3000.0, "500 m"), (4.0, "1 m"), (2.0, "50 cm"), (0.02, "5 mm")]
)
def test_it_has_the_unit_that_people_say(distance, text):
    bar: Any = scale_bar(camera(distance), 400, 400)
    assert bar.text == text


def test_a_camera_that_looks_at_itself_has_none():
    assert scale_bar(camera(0.0), 800, 400) is None
