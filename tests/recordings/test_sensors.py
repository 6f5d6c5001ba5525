from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

from recordings import RecordedSensor, RecordingError
from recordings.depth_images import pixels
from recordings.sensors import distances, status_codes, valid
from robot_assets import SensorModel
from tests.recordings.pictures import picture

SENSOR = RecordedSensor(
    "eye", "", "eye", SensorModel().directions, lambda values: values, (0.0, np.inf)
)
COUNTING = np.arange(64).reshape(8, 8)


def readings(
    image: SimpleNamespace, status: SimpleNamespace | None, sensor: RecordedSensor
) -> np.ndarray:
    """Readings (rows, columns) of an image and of the status beside it, NaN where invalid."""
    codes = np.full(sensor.grid, 255, np.uint8) if status is None else status_codes(status, sensor)
    values, with_status = distances(image, sensor), np.array([status is not None])
    good = valid(values[None], codes[None], with_status, np.array([sensor.limits]))[0]
    return np.where(good, values, np.nan)


def test_16_bits_are_millimetres_with_0_for_invalid():
    values = readings(picture(COUNTING.astype("<u2"), "16UC1"), None, SENSOR)
    assert np.isnan(values[0, 0])
    assert values[7, 7] == pytest.approx(0.063)


def test_32_bits_are_metres_with_nan_for_invalid():
    metres = COUNTING.astype("<f4")
    metres[3, 3] = np.nan
    metres[3, 4] = np.inf
    values = readings(picture(metres, "32FC1"), None, SENSOR)
    assert np.isnan(values[[0, 3, 3], [0, 3, 4]]).all()
    assert values[7, 7] == 63.0


def test_big_endian_and_padded_rows_are_read():
    big = picture(COUNTING.astype(">u2"), "mono16")
    assert readings(big, None, SENSOR)[7, 7] == pytest.approx(0.063)
    padded = np.zeros((8, 12), "<u2")
    padded[:, :8] = COUNTING
    image = picture(padded, "16UC1", width=8)
    assert readings(image, None, SENSOR)[7, 7] == pytest.approx(0.063)


def test_an_image_with_too_few_bytes_is_refused():
    image = picture(COUNTING.astype("<u2"), "16UC1", data=np.zeros(100, np.uint8))
    with pytest.raises(RecordingError, match="100 bytes"):
        pixels(image, np.dtype("u2"))


@pytest.mark.parametrize("more", [{"width": 16}, {"height": 4}, {"encoding": "8UC1"}])
def test_a_later_image_of_another_kind_is_refused(more: dict[str, object]):
    image = picture(COUNTING.astype("<u2"), "16UC1")
    vars(image).update(more)
    with pytest.raises(RecordingError, match="and not 8 x 8 distances"):
        readings(image, None, SENSOR)


def test_only_valid_status_counts_whatever_the_distance_says():
    status = np.full((8, 8), 255, np.uint8)
    status[1, 1], status[2, 2], status[3, 3] = 5, 9, 4
    image = picture(np.full((8, 8), 1000, "<u2"), "16UC1")
    values = readings(image, picture(status, "8UC1"), SENSOR)
    assert np.argwhere(np.isfinite(values)).tolist() == [[1, 1], [2, 2]]


def test_a_status_of_another_size_is_refused():
    image = picture(np.full((8, 8), 1000, "<u2"), "16UC1")
    status = picture(np.full((4, 4), 5, np.uint8), "8UC1", height=4, width=4, step=4)
    with pytest.raises(RecordingError, match="its status image is 4 x 4, and not 8 x 8"):
        readings(image, status, SENSOR)


def test_the_models_order_and_limits_are_applied():
    model = SensorModel(flip_vertical=True, flip_horizontal=True)
    sensor = replace(SENSOR, arrange=model.arrange, limits=(0.01, 0.06))
    values = readings(picture(COUNTING.astype("<u2"), "16UC1"), None, sensor)
    assert np.isnan(values[0, :3]).all()
    assert values[0, 3] == pytest.approx(0.060)
    assert np.isnan(values[7, 0])
