import csv

import pytest

from app.analysis.estimates import Estimates
from app.analysis.survey import Survey
from app.exports.survey_csv import to_csv
from estimator import Parameters
from tests.app.fake_recordings import FRAMES, fake_opened, fake_recording


def test_the_file_says_what_it_is_and_holds_a_line_per_frame():
    opened = fake_opened()
    survey = Survey(opened.recording, Parameters(gamma=0.6))
    survey.put(20, Estimates().estimated(opened, 20, survey.parameters))
    heading, *lines = to_csv(opened.recording, survey).splitlines()
    assert heading.startswith("# Tofscope; recording fake.mcap; measured; n=8;")
    assert "gamma=0.6;" in heading
    assert heading.endswith(f"9 of {FRAMES} frames computed")
    rows = list(csv.DictReader(lines))
    assert [int(row["frame"]) for row in rows] == list(range(FRAMES))
    assert rows[19]["speed estimated [m/s]"] == ""
    row = rows[20]
    assert row["moving points [count]"] == "100"
    assert float(row["speed estimated [m/s]"]) == pytest.approx(0.15, abs=1e-3)
    assert float(row["speed true [m/s]"]) == pytest.approx(0.15)
    assert float(row["angle deviation [deg]"]) == pytest.approx(0, abs=0.1)
    assert float(row["coverage [1]"]) == float(row["precision [1]"]) == 1
    assert float(row["time [s]"]) == pytest.approx(20 / 15, abs=1e-6)
    assert float(row["stamp [s]"]) == pytest.approx(100 + 20 / 15)


def test_simulated_data_are_called_so():
    fake = fake_recording(name='two\nlines,"=1+1;\udcff')
    fake.simulated = True
    text = to_csv(fake, Survey(fake, Parameters()))
    assert text.startswith("# Tofscope; recording two lines =1+1 \\udcff.mcap; simulated; ")
