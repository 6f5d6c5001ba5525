"""What the benchmarks estimate is what their rows say."""

from benchmarks.inputs import WHOLE, fresh, sample_windows, whole_windows, wide_rig
from estimator import Parameters, estimate


def test_the_whole_recording_has_as_many_pairs_as_its_rows_say():
    assert len(whole_windows()) == WHOLE


def test_the_wide_rig_has_100_sensors_of_different_names():
    names = [sensor.name for sensor in wide_rig().sensors]
    assert len(names) == len(set(names)) == 100


def test_of_a_fresh_window_nothing_is_kept():
    window = sample_windows()[0]
    estimate(window, Parameters())
    assert len(window.stages) > 0
    assert len(fresh(window).stages) == 0
