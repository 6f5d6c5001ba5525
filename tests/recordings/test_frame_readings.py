"""Readings of all sensors of a frame, and what becomes of messages that cannot be used."""

from types import SimpleNamespace
from typing import Any

import numpy as np

from recordings import RecordedSensor
from recordings.depth_images import DEPTH_IMAGE
from recordings.frame_readings import FrameReadings
from recordings.sensors import DepthStream
from robot_assets import SensorModel
from tests.recordings.pictures import picture

METRE = np.full((8, 8), 1000, "<u2")
ALL = np.zeros((8, 8), np.uint8) + 5


class Messages:
    """A decoder whose messages are these, by topic; None cannot be read."""

    def __init__(self, **messages: list[Any]) -> None:
        self._messages = messages
        self.left_out: list[str] = []

    def readable(self, channel: str, index: int) -> Any:
        return self._messages[channel][index]

    def leave_out(self, channel: str, index: int, reason: str) -> None:
        self.left_out.append(f"{channel} {index}: {reason}")


def stream(name: str, size: int = 8, status: list[int] | None = None) -> DepthStream:
    model = SensorModel(rows=size, columns=size)
    sensor = RecordedSensor(name, "", name, model.directions, model.arrange, (0.0, 2.0))
    of_status: Any = None if status is None else SimpleNamespace(channel=f"{name}_status")
    topic: Any = SimpleNamespace(channel=name)
    return DepthStream(topic, sensor, of_status, np.array(status or []), DEPTH_IMAGE)


def readings(decoder: Any, *streams: DepthStream, messages: list[int]):
    return FrameReadings(streams, decoder, (8, 8)).at(np.array(messages))


def test_sensors_of_several_sizes_and_one_without_a_message():
    decoder = Messages(a=[None, picture(METRE, "16UC1")], b=[picture(METRE[:4, :4] * 2, "16UC1")])
    streams = stream("a"), stream("b", 4), stream("c")
    values, status = readings(decoder, *streams, messages=[1, 0, -1])
    assert (values[0] == 1.0).all()
    assert (values[1, :4, :4] == 2.0).all()
    assert np.isnan(values[1, 4:]).all()
    assert np.isnan(values[1, :, 4:]).all()
    assert np.isnan(values[2]).all()
    assert status is None


def test_the_status_of_one_sensor_says_nothing_of_another():
    some = ALL.copy()
    some[0] = 4
    images = {name: [picture(METRE, "16UC1")] for name in ("a", "b")}
    decoder = Messages(**images, a_status=[picture(some, "8UC1")])
    values, status = readings(decoder, stream("a", status=[0]), stream("b"), messages=[0, 0])
    assert np.isnan(values[0, 0]).all()
    assert (values[0, 1:] == 1.0).all()
    assert (values[1] == 1.0).all()
    assert status is not None
    assert (status[0] == some).all()
    assert (status[1] == 255).all()


def test_a_sensor_whose_message_or_status_cannot_be_used_has_no_readings():
    good = picture(METRE, "16UC1")
    short = picture(METRE, "16UC1", data=np.zeros(9, np.uint8))
    decoder = Messages(a=[short], b=[good], b_status=[None], c=[None], d=[good])
    streams = stream("a"), stream("b", status=[0]), stream("c"), stream("d")
    values, status = readings(decoder, *streams, messages=[0, 0, 0, 0])
    assert np.isfinite(values).any(axis=(1, 2)).tolist() == [False, False, False, True]
    assert status is None
    assert decoder.left_out == [
        "a 0: it has 9 bytes in rows of 16, too few for 8 x 8 zones in 16UC1"
    ]


def test_what_lies_beyond_the_limits_or_is_no_number_is_no_reading():
    metres = np.full((8, 8), 2.0, "<f4")
    metres[0, :5] = [2.1, np.inf, np.nan, 0.0, -1.0]
    values, _ = readings(Messages(a=[picture(metres, "32FC1")]), stream("a"), messages=[0])
    assert np.isnan(values[0, 0, :5]).all()
    assert np.isfinite(values).sum() == 59
