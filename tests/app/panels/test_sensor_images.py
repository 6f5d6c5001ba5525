"""Images of the sensors, as the page gets them."""

import base64
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from app.analysis.estimates import Estimates
from app.analysis.pairs import prepare_pair
from app.analysis.zones import SOURCE, TARGET, ZoneState
from app.panels.sensor_images import (
    LABELS,
    STATES,
    Look,
    images,
    layout,
    scale_limit,
    stride,
)
from app.scene.settings import ViewSettings
from app.session.inspection import BY_LABEL, ImageSettings
from estimator import Label, Parameters
from recordings import open_recording
from tests.app.fake_recordings import fake_opened
from tests.recordings.foreign import ForeignFile, at, image, transforms
from tests.recordings.test_joints import STEP

PALETTE = ViewSettings().palette
LOOK = Look(ImageSettings(), PALETTE, dark=False, limit=2.0)
OPENED = fake_opened()


@pytest.fixture(scope="module")
def pair():
    return Estimates().estimated(OPENED, 20, Parameters())


def numbers(text: str) -> np.ndarray:
    return np.frombuffer(base64.b64decode(text), dtype=np.uint8)


def bits(text: str, count: int) -> np.ndarray:
    return np.unpackbits(numbers(text))[:count].astype(bool)


def test_distances_are_parts_of_the_scale_and_what_moves_is_marked(pair):
    found = images(OPENED.recording, pair, 4.0, None, LOOK)
    assert found is not None
    assert found["title"] == "Frame 20 (target)"
    assert set(numbers(found["values"])) == {int(STATES * 0.5**0.5)}
    moving = bits(found["moves"], 500)
    assert moving[400:].all()
    assert not moving[:400].any()
    assert found["counts"] == [100]
    assert (found["absent"], found["late"], found["selected"]) == ([], [], None)
    assert "not a cloud's colour" in found["note"]


@pytest.mark.parametrize(("side", "other"), [(SOURCE, Label.STATIONARY), (TARGET, 3)])
def test_labels_have_the_colours_of_the_scene(pair, side, other):
    settings = ImageSettings(side=side, colours=BY_LABEL)
    found = images(OPENED.recording, pair, 4.0, None, replace(LOOK, images=settings))
    assert found is not None
    values = numbers(found["values"])
    assert set(values[400:]) == {LABELS + Label.MOVING}
    assert set(values[:400]) == {LABELS + other}
    colours = numbers(found["colours"]).reshape(256, 4)
    expected = PALETTE.source if side == SOURCE else PALETTE.target
    assert tuple(colours[LABELS + Label.MOVING]) == (*expected, 255)


def test_before_there_is_a_source_there_is_no_image_of_it():
    early = Estimates().estimated(OPENED, 2, Parameters())
    look = replace(LOOK, images=ImageSettings(side=SOURCE))
    assert images(OPENED.recording, early, 4.0, None, look) is None


def test_an_enlarged_image_says_distances_in_numbers(pair):
    found = images(OPENED.recording, pair, 4.0, 0, LOOK)
    assert found is not None
    chosen = found["selected"]
    assert (chosen["rows"], chosen["columns"]) == (20, 25)
    assert chosen["title"] == "front, read at the frame's stamp"
    assert chosen["texts"] is None  # too many to be read


def test_a_frame_without_points_has_an_image_of_states(tmp_path: Path):
    file = ForeignFile()
    wall, codes = np.full((4, 4), 1200, "<u2"), np.full((4, 4), 5, np.uint8)
    wall[0, 3], codes[0, 1] = 600, 4  # right above, as the sensor sees it
    for k in range(2):
        ranges, status = (
            image(k * STEP, "eye", v, e) for v, e in ((wall, "16UC1"), (codes, "8UC1"))
        )
        file.add("/eye/image", "sensor_msgs/msg/Image", ranges, k * STEP)
        file.add("/eye/status", "sensor_msgs/msg/Image", status, k * STEP)
    fixed = transforms(0, [("world", "eye", at())])
    file.add("/tf_static", "tf2_msgs/msg/TFMessage", fixed, 0)
    with open_recording(file.write(tmp_path / "x.mcap")) as recording:
        pair = prepare_pair(recording, 1, Parameters(n=1)).pair
        found = images(recording, pair, 4.0, 0, LOOK)
        assert found is not None
        values = numbers(found["values"]).reshape(4, 4)
        # The near zone is in the image where it is in the scene: x is right, y down.
        near = np.unravel_index(values.argmin(), values.shape)
        assert near == (0, 3)
        (point,) = pair.target.points[pair.target.zone == 3]
        assert point[0] > 0 > point[1]
    assert values[0, 1] == STATES + ZoneState.REFUSED
    texts = np.reshape(found["selected"]["texts"], (4, 4))
    assert texts[0].tolist() == ["1.20", "s4", "1.20", "0.60"]


def test_the_scale_is_round_and_never_shrinks(pair):
    cloud = pair.target
    assert scale_limit(cloud, 0.0) == 1.0
    assert scale_limit(cloud, 3.0) == 3.0
    assert scale_limit(replace(cloud, ranges=np.full((1, 2, 2), 55.0)), 0.0) == 12.0
    assert scale_limit(replace(cloud, ranges=np.full((1, 2, 2), np.nan)), 0.0) == 0.5


def test_many_zones_are_thinned_out_until_a_message_is_small():
    (sensor,) = OPENED.recording.sensors
    assert stride([sensor]) == 1
    assert stride([sensor] * 100) == 4
    assert layout(OPENED.recording)["grids"] == [[20, 25]]
