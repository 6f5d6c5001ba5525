import csv
import io
import json

import numpy as np
import pytest

from app.analysis.estimates import Estimates
from app.errors import InputError
from app.exports.flow_file import CSV, NPZ, flow_file, flow_table
from estimator import Label, Parameters
from tests.app.fake_recordings import fake_opened, fake_recording

COLUMNS = ["x", "y", "z", "vx", "vy", "vz", "label", "cluster", "sensor", "zone"]


@pytest.fixture(scope="module")
def pairs():
    estimates, opened = Estimates(), fake_opened()
    return [estimates.estimated(opened, k, Parameters()) for k in range(5, 22)]


def made(pairs, kind, *, several, recording=None):
    table = flow_table(pairs, several=several)
    return flow_file(recording or fake_recording(), Parameters(), table, kind)


def test_a_line_of_the_csv_file_is_a_source_point(pairs):
    (pair,) = (pair for pair in pairs if pair.frame == 20)
    text = made([pair], CSV, several=False).decode()
    comments = [line for line in text.splitlines() if line.startswith("#")]
    about = json.loads(comments[0].split("; ", 1)[1])
    assert (about["Recording"], about["Data"]) == ("fake", "measured")
    assert about["Frame"].startswith("20 of 39")
    assert "2 moving" in comments[1]
    assert all(sensor.name in comments[2] for sensor in fake_recording().sensors)
    rows = list(csv.reader(line for line in text.splitlines() if line[0] != "#"))
    assert rows[0] == COLUMNS
    values = np.array([[float(cell or "nan") for cell in row] for row in rows[1:]])
    np.testing.assert_allclose(values[:, :3], pair.source.points, rtol=1e-5, atol=1e-6)
    np.testing.assert_allclose(values[:, 3:6], pair.flow.velocity, rtol=1e-5, atol=1e-6)
    np.testing.assert_array_equal(values[:, 6], pair.flow.label)
    np.testing.assert_array_equal(values[:, 7], pair.flow.cluster)
    np.testing.assert_array_equal(values[:, 8], pair.source.sensor)
    np.testing.assert_array_equal(values[:, 9], pair.source.zone)
    assert np.isnan(values[values[:, 6] != Label.MOVING, 3:6]).all()


def test_a_range_of_frames_names_the_frame_of_each_point(pairs):
    with np.load(io.BytesIO(made(pairs, NPZ, several=True)), allow_pickle=False) as arrays:
        assert list(arrays)[:11] == ["frame", *COLUMNS]
        # Frames without a frame n before have no flow.
        np.testing.assert_array_equal(arrays["frames"], range(8, 22))
        np.testing.assert_array_equal(np.unique(arrays["frame"]), range(8, 22))
        np.testing.assert_allclose(arrays["intervals"], 8 / 15)
        pair = pairs[-1]
        of_last = arrays["frame"] == 21
        np.testing.assert_array_equal(arrays["x"][of_last], pair.source.points[:, 0])
        np.testing.assert_array_equal(arrays["vz"][of_last], pair.flow.velocity[:, 2])
        assert arrays["labels"][Label.MOVING] == "moving"
        assert json.loads(str(arrays["about"]))["Method"] == "paper"
    header = made(pairs, CSV, several=True).decode().splitlines()[3]
    assert header.split(",") == ["frame", *COLUMNS]


def test_simulated_data_are_called_so(pairs):
    recording = fake_recording(name="two\nlines")
    recording.simulated = True
    text = made(pairs[-1:], CSV, several=False, recording=recording).decode()
    assert '"Data": "simulated' in text.splitlines()[0]
    assert not text.splitlines()[1].startswith("lines")


def test_without_any_flow_it_says_why(pairs):
    with pytest.raises(InputError, match="no frame lies n before"):
        flow_table(pairs[:2], several=True)
