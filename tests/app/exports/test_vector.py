import re
import zlib
from dataclasses import replace
from xml.etree import ElementTree

import numpy as np
import pytest
import trimesh

from app.analysis.comparison import Comparison
from app.analysis.estimates import Estimates
from app.exports.drawn_pair import DrawnPair
from app.exports.figure_settings import FigureSettings
from app.exports.figure_size import FigureSize
from app.exports.outline import Sight
from app.exports.pinhole import Pinhole
from app.exports.solid import Solid
from app.exports.vector import PDF, SVG, vector_figure
from app.scene.camera import Camera
from app.scene.colours import css
from app.scene.settings import ViewSettings
from app.scene.views import ABOVE, SLANTED
from estimator import Parameters
from recordings import open_recording, sample_paths
from tests.app.fake_recordings import fake_opened, fake_recording

PRINTED = FigureSettings(FigureSize.in_millimetres(88, 62), (SLANTED, ABOVE))
CAMERA = Camera((4.0, 0.0, 0.0), (0.0, 0.0, 0.0), 0.6)


def pair(n=8):
    return Estimates().estimated(fake_opened(), 20, Parameters(n=n))


def drawing(kind=SVG, settings=None, figure=PRINTED, drawn=None):
    shown = settings or ViewSettings()
    drawn = drawn or DrawnPair(pair(), Parameters())
    return vector_figure(fake_recording(), drawn, shown, figure, kind)


def fills(svg: bytes) -> set[str]:
    return set(re.findall(r"(?:fill|stroke): (#[0-9a-f]{6})", svg.decode()))


def test_text_is_text_and_the_size_is_that_of_the_figure():
    svg = drawing()
    root = ElementTree.fromstring(svg)
    assert float(root.attrib["width"].removesuffix("pt")) == pytest.approx(249.4, abs=0.5)
    texts = {text.text for text in root.iter("{http://www.w3.org/2000/svg}text")}
    assert {"(a)", "(b)", "Target: moving", "x", "y", "z"} <= texts
    assert any(text and text.startswith("fake") and "frame 20 of 39" in text for text in texts)
    sizes = re.findall(r"font-size: ([\d.]+)px", svg.decode())
    assert sizes
    assert min(map(float, sizes)) >= 7


def test_points_and_arrows_have_the_colours_of_the_legend():
    palette = ViewSettings().palette
    assert {css(palette.source), css(palette.target), css(palette.flow)} <= fills(drawing())
    hidden = frozenset(ViewSettings().layers - {"Flow", "Frustums"})
    assert css(palette.flow) not in fills(drawing(settings=replace(ViewSettings(), layers=hidden)))


def texts_of(svg: bytes) -> set[str]:
    root = ElementTree.fromstring(svg)
    return {text.text or "" for text in root.iter("{http://www.w3.org/2000/svg}text")}


def test_a_picked_cluster_has_a_box_a_label_and_an_entry_in_the_legend():
    shown = pair()
    assert shown.flow is not None
    picked = shown.flow.clusters[0]
    svg = drawing(drawn=DrawnPair(shown, Parameters(), picked=picked))
    colour = css(ViewSettings().palette.picked)
    assert f"stroke: {colour}" in svg.decode()
    label = f"Cluster {picked.index}: {picked.label.name.lower()}"
    assert {label, f"Picked: cluster {picked.index}"} <= texts_of(svg)
    assert colour not in fills(drawing())


def test_where_a_and_b_are_drawn_the_file_says_so_of_both():
    both = Comparison(Parameters(n=4), "B", both=True)
    drawn = DrawnPair(pair(), Parameters(), both, pair(n=4))
    texts = texts_of(drawing(drawn=drawn))
    assert {
        "Flow of A: displacement in 0.27 s × 1",
        "Flow of B: displacement in 0.53 s × 1",
    } <= texts
    assert any("A: paper n 4" in text for text in texts)
    palette = ViewSettings().palette
    assert {css(palette.flow), css(palette.second)} <= fills(drawing(drawn=drawn))


def test_an_optical_frame_does_not_say_where_the_ground_is():
    recording = fake_recording()
    grid = css(ViewSettings().palette.grid[1])
    assert grid in fills(drawing())
    recording.fixed_frame = "camera_optical_frame"
    drawn = DrawnPair(pair(), Parameters())
    assert grid not in fills(vector_figure(recording, drawn, ViewSettings(), PRINTED, SVG))


def test_equal_drawings_are_equal_files_that_say_what_they_show():
    first = drawing(PDF)
    assert first == drawing(PDF)
    assert first.startswith(b"%PDF")
    assert b"Made with Tofscope" in first
    assert b"/Subtype /Type42" in first.replace(b"/Subtype /CIDFontType2", b"/Subtype /Type42")
    assert b"measured" in drawing(SVG)
    assert drawing(SVG) == drawing(SVG)


def test_a_sample_is_small_and_shows_its_robot():
    path = next(path for path in sample_paths() if "robot_moving" in path.name)
    with open_recording(path) as recording:
        pair = Estimates().estimated(fake_opened(recording), 24, Parameters())
        drawn = DrawnPair(pair, Parameters())
        settings = ViewSettings()
        svg, bare = (
            vector_figure(recording, drawn, shown, PRINTED, SVG)
            for shown in (settings, replace(settings, layers=settings.layers - {"Robot"}))
        )
    assert len(svg) < 2e6
    assert len(svg) > len(bare) + 100_000
    assert b"simulated" in svg
    assert b"#cc0000" in svg, "the fixed frame has no axes"
    assert len(re.findall(rb"fill-opacity: 0\.0", svg)) > 20, "there is no shadow"


def cube(middle) -> Solid:
    mesh = trimesh.creation.box((1.0, 1.0, 1.0))
    mesh.apply_translation(middle)
    count = len(mesh.faces)
    return Solid(mesh, np.full((count, 3), 200, np.uint8), np.ones(count, dtype=bool))


def test_what_is_behind_the_solid_is_hidden():
    sight = Sight(Pinhole(CAMERA, 100, 100), cube((0.0, 0.0, 0.0)))
    seen = sight.sees(np.array([[1.0, 0, 0], [-1.0, 0, 0], [-1.0, 1.5, 0]]))
    np.testing.assert_array_equal(seen, [True, False, True])
    line = np.array([[[-1.0, -1.5, 0.1], [-1.0, 1.5, 0.1]]])
    parts = sight.seen_parts(line)
    assert len(parts) == 2
    lengths = np.linalg.norm(parts[:, 1] - parts[:, 0], axis=1)
    whole = np.linalg.norm(np.subtract(*Pinhole(CAMERA, 100, 100).project(line[0])[0]))
    # The shadow of the cube's half metre, from 3.5 m, on a line at 5 m.
    assert lengths.sum() == pytest.approx(whole * (1 - 2 * 0.5 * 5 / 3.5 / 3.0), rel=0.05)


def test_the_outline_of_a_cube_seen_from_the_front_is_a_square():
    lines = Sight(Pinhole(CAMERA, 100, 100), cube((0.0, 0.0, 0.0))).outline()
    half = 50 / np.tan(0.3) * 0.5 / 3.5
    ends = lines.reshape(-1, 2) - 50
    np.testing.assert_allclose(np.abs(ends).max(axis=1), half, rtol=1e-3)
    assert np.linalg.norm(lines[:, 1] - lines[:, 0], axis=1).sum() == pytest.approx(
        8 * half, rel=0.02
    )


def test_shades_cover_what_the_solid_covers():
    shades = Sight(Pinhole(CAMERA, 100, 100), cube((0.0, 0.0, 0.0))).shades()
    assert shades is not None
    half = 50 / np.tan(0.3) * 0.5 / 3.5
    across = (shades.colour[len(shades.y) // 2] >= 0).sum() * (shades.x[1] - shades.x[0])
    assert across == pytest.approx(2 * half, abs=0.6)
    assert Sight(Pinhole(CAMERA, 100, 100), None).shades() is None


def test_a_long_text_in_a_pdf_is_not_lost():
    content = drawing(PDF)
    streams = re.findall(rb"stream\r?\n(.*?)endstream", content, re.S)
    drawn = b"".join(zlib.decompress(s) for s in streams if s[:1] == b"x")
    assert b"Tj" in drawn or b"TJ" in drawn
