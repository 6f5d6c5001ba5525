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
    heading, *lines = to_csv(opened.recording, {"A": survey}).splitlines()
    assert heading.startswith("# Tofscope; recording fake.mcap; measured; n=8;")
    assert "gamma=0.6;" in heading
    assert heading.endswith(f"9 of {FRAMES} frames computed")
    rows = list(csv.DictReader(lines))
    assert [int(row["frame"]) for row in rows] == list(range(FRAMES))
    assert rows[19]["estimated speed [m/s]"] == ""
    row = rows[20]
    assert row["moving points [count]"] == "100"
    assert float(row["estimated speed [m/s]"]) == pytest.approx(0.15, abs=1e-3)
    assert float(row["true speed [m/s]"]) == pytest.approx(0.15)
    assert float(row["angle deviation [deg]"]) == pytest.approx(0, abs=0.1)
    assert float(row["coverage [1]"]) == float(row["precision [1]"]) == 1
    assert row["counts in the means [0 or 1]"] == "1"
    assert row["clusters [count]"] == "5"
    assert float(row["time [s]"]) == pytest.approx(20 / 15, abs=1e-6)
    assert float(row["stamp [s]"]) == pytest.approx(100 + 20 / 15)


def test_simulated_data_are_called_so():
    fake = fake_recording(name='two\nlines,"=1+1;\udcff')
    fake.simulated = True
    text = to_csv(fake, {"A": Survey(fake, Parameters())})
    assert text.startswith("# Tofscope; recording two lines =1+1 \\udcff.mcap; simulated; ")


def test_a_and_b_stand_beside_each_other():
    opened = fake_opened()
    surveys = {"A": Survey(opened.recording, Parameters())}
    surveys["B"] = Survey(opened.recording, Parameters(n=5))
    surveys["B"].put(20, Estimates().estimated(opened, 20, Parameters(n=5)))
    of_a, of_b, *lines = to_csv(opened.recording, surveys).splitlines()
    assert of_a.startswith("# A: Tofscope; ")
    assert "; n=8;" in of_a
    assert of_b.startswith("# B: Tofscope; ")
    assert "; n=5;" in of_b
    row = list(csv.DictReader(lines))[20]
    assert row["A: moving points [count]"] == ""
    assert row["B: moving points [count]"] == "100"
    assert "time [s]" in row
