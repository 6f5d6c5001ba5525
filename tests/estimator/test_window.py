"""Windows of frames: loaded when they are asked for, checked, and never written to."""

import numpy as np
import pytest

from estimator import CloudError, LazyFrames, PlainCloud, Window, window_of_pair


def frame(x: float, stamp: float) -> PlainCloud:
    none = np.zeros(1, dtype=np.int64)
    return PlainCloud(np.array([[x, 0.0, 0.0]]), none, none, stamp)


def test_frames_are_loaded_when_they_are_asked_for_and_once():
    asked = []
    frames = LazyFrames(4, lambda i: asked.append(i) or frame(i, i))
    window = Window(frames, np.arange(4.0))
    assert (window.source.points[0, 0], window.target.points[0, 0]) == (0, 3)
    assert asked == [0, 3]
    assert [f.points[0, 0] for f in window.frames] == [0, 1, 2, 3]
    assert asked == [0, 3, 1, 2]
    assert [f.stamp for f in window.frames[1:3]] == [1, 2]
    assert window.interval == 3.0


def test_frames_that_are_there_are_not_loaded():
    frames = LazyFrames(3, lambda i: pytest.fail("loaded"), {0: frame(5, 0), 2: frame(6, 2)})
    assert frames[-1].points[0, 0] == 6
    assert len(frames) == 3


@pytest.mark.parametrize("index", [3, -4])
def test_there_is_no_frame_beyond_the_window(index):
    with pytest.raises(IndexError, match="There are 3 frames"):
        LazyFrames(3, lambda i: frame(i, i))[index]


def test_a_frame_between_is_checked_as_the_others_are():
    frames = LazyFrames(3, lambda i: frame(1e200 if i == 1 else i, i))
    with pytest.raises(CloudError, match="frame 1 of the window must lie within"):
        list(frames)


def test_an_error_of_loading_comes_through_and_may_pass():
    broken = [True]

    def load(index: int) -> PlainCloud:
        if broken[0]:
            raise OSError("gone")
        return frame(index, index)

    frames = LazyFrames(2, load)
    with pytest.raises(OSError, match="gone"):
        frames[0]
    broken[0] = False
    assert frames[0].points[0, 0] == 0


def test_plain_points_have_no_rays_and_cannot_be_written_to():
    given = np.zeros((2, 3))
    window = window_of_pair(given, given, 0.5)
    assert window.source.ranges.shape == (0, 0, 0)
    assert window.source.directions.shape == (0, 0, 0, 3)
    assert window.source.T_fixed_sensor.shape == (0, 4, 4)
    assert (window.source.sensor == -1).all()
    assert [f.stamp for f in window.frames] == [0.0, 0.5]
    for values in (window.source.points, window.source.ranges, window.source.sensor):
        with pytest.raises(ValueError, match="read-only"):
            values[...] = 1
    given[0] = 1.0  # the caller's own array stays the caller's
