"""Plots as a figure for print."""

import io
import zlib
from xml.etree import ElementTree as ET

import numpy as np
import pytest
from PIL import Image

from app.analysis.estimates import Estimates
from app.analysis.survey import Survey
from app.exports.survey_figure import survey_figure
from app.panels.plot_list import PLOTS
from app.scene.palettes import COLOUR_BLIND, PAPER, palette
from estimator import Parameters
from tests.app.analysis.test_survey import filled
from tests.app.fake_recordings import fake_opened, fake_recording


@pytest.fixture(scope="module")
def opened():
    fake = fake_recording(name="a_<b>_$x$")
    fake.simulated = True
    fake.truth = lambda k: np.zeros(3) if k < 20 else np.array([0.0, 0.15, 0.0])
    return fake_opened(fake)


@pytest.fixture(scope="module")
def surveys(opened):
    estimates = Estimates()
    return {
        "A": filled(opened, Parameters(), estimates),
        "B": filled(opened, Parameters(method="baseline"), estimates),
    }


def texts(svg):
    return [e.text or "" for e in ET.fromstring(svg).iter("{http://www.w3.org/2000/svg}text")]


def colour(triple):
    return "#{:02x}{:02x}{:02x}".format(*triple)


def test_text_stays_text_with_units_means_and_sides(opened, surveys):
    svg = survey_figure(opened.recording, surveys, PLOTS, "svg", pair=("moving", "angle_deg"))
    said = texts(svg)
    assert "a_<b>_$x$ (simulated)" in said
    assert "Time [s]" in said
    assert "Estimated speed [m/s]" in said
    precision = "Precision: mean A 1.000, 12 of 32 pairs count; B 0.200, 12 of 32 pairs count"
    assert precision in said
    assert "Moving points" in said  # the horizontal axis of the two quantities
    assert {"A", "B", "true", "hollow: does not count in the means"} <= set(said)
    for part in (b"Parameters of A", b"Parameters of B", b"baseline", b"simulated"):
        assert part in svg


@pytest.mark.parametrize("name", [PAPER, COLOUR_BLIND])
def test_both_sides_have_the_colours_of_the_palette_and_hollow_points(opened, surveys, name):
    svg = survey_figure(opened.recording, surveys, PLOTS, "svg", colours=name).decode()
    look = palette(name, dark=False)
    for side in ("A", "B"):
        assert f"fill: {colour(look.side(side))}" in svg
        assert f"fill: none; stroke: {colour(look.side(side))}" in svg.replace(
            f"fill-opacity: 0; stroke: {colour(look.side(side))}",
            f"fill: none; stroke: {colour(look.side(side))}",
        )
    assert colour(look.truth) in svg


def test_one_side_of_measured_data_without_truth(surveys):
    fake = fake_recording()
    fake.has_truth = False
    svg = survey_figure(fake, {"A": surveys["A"]}, ("moving", "speed"), "svg")
    said = texts(svg)
    assert "fake (measured)" in said
    assert "estimated" in said
    assert not {"true", "hollow: does not count in the means"} & set(said)


def test_a_png_says_where_it_comes_from_and_equal_plots_give_equal_files(opened, surveys):
    png = survey_figure(opened.recording, surveys, PLOTS[:2], "png")
    image = Image.open(io.BytesIO(png))
    assert image.info["Data"] == "simulated"
    assert image.info["Software"] == "Tofscope"
    assert '"baseline"' in image.info["Parameters of B"]
    assert image.convert("RGB").getpixel((2, 2)) == (255, 255, 255)
    assert survey_figure(opened.recording, surveys, PLOTS[:2], "png") == png


def test_a_pdf_says_where_it_comes_from(opened, surveys):
    incomplete = {"A": Survey(opened.recording, Parameters())}
    pdf = survey_figure(opened.recording, incomplete, PLOTS[:2], "pdf")
    assert pdf.startswith(b"%PDF")
    parts = [pdf]
    for stream in pdf.split(b"stream\n")[1:]:
        try:
            parts.append(zlib.decompressobj().decompress(stream))
        except zlib.error:
            continue
    whole = b"".join(parts)
    assert b"Fixed frame: world" in whole
    assert b"Incomplete: not all frames of A are computed" in whole
    assert b"/FontFile2" in pdf  # TrueType: text that can be searched
