import re
import zlib
from dataclasses import replace
from io import BytesIO

from PIL import Image

from app.study.figure import sweep_figure
from tests.app.study.made import PLAN, good, made

ROWS = [
    made(speed=speed, n=n, metrics=good(6.0, 0.03) if n < 10 else {})
    for speed in (0.15, 0.20, 0.25, 0.30)
    for n in (1, 8, 10)
]


def test_the_figure_is_a_column_wide_per_method_and_a_vector_graphic_with_letters():
    one, two = (
        sweep_figure(replace(PLAN, methods=methods), ROWS)
        for methods in (("paper",), ("paper", "baseline"))
    )
    assert one is not None
    assert two is not None
    sizes = [Image.open(BytesIO(files["png"])).size for files in (one, two)]
    assert [width for width, _ in sizes] == [1050, 2100]
    pdf = one["pdf"]
    assert pdf.startswith(b"%PDF")
    assert b"/FontFile2" in pdf  # TrueType, and not letters drawn as pictures or Type 3
    assert b"/Type3" not in pdf
    assert b"/Subtype /Image" not in pdf


def test_every_speed_has_a_dash_of_its_own_without_colour():
    files = sweep_figure(replace(PLAN, methods=("paper",)), ROWS)
    assert files is not None
    streams = re.findall(rb"stream\r?\n(.*?)endstream", files["pdf"], re.S)
    drawn = b"".join(_inflated(stream) for stream in streams)
    dashes = set(re.findall(rb"\[([\d. ]*)\] [\d.]+ d", drawn))
    assert len(dashes) >= 4


def _inflated(stream: bytes) -> bytes:
    try:
        return zlib.decompress(stream)
    except zlib.error:
        return b""


def test_the_same_study_gives_the_same_files():
    assert sweep_figure(PLAN, ROWS) == sweep_figure(PLAN, ROWS)


def test_what_could_not_be_computed_changes_the_figure():
    whole = [replace(row, metrics=good(6.0, 0.03)) for row in ROWS]
    assert sweep_figure(PLAN, ROWS) != sweep_figure(PLAN, whole)


def test_without_a_sweep_there_is_no_figure():
    assert sweep_figure(replace(PLAN, sweep=()), ROWS) is None
    assert sweep_figure(PLAN, [made("sideways", metrics=good(6.0, 0.03))]) is None
