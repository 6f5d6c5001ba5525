"""Text in files that programs of others open."""

import pytest

from app.output.text import csv_cell, escaped, utf8


@pytest.mark.parametrize("begin", ["=", "+", "-", "@", "\t", "＝"])
def test_a_text_that_a_spreadsheet_would_run_is_a_text(begin: str):
    assert csv_cell(f"{begin}cmd|' /C calc'!A0") == f"'{begin}cmd|' /C calc'!A0"


@pytest.mark.parametrize(
    "value", ["towards_0.25_1", "a=b", "", "-0.5", "+1e-3", "-inf", -0.5, 3, None, True]
)
def test_numbers_and_other_texts_stay_as_they_are(value: object):
    assert csv_cell(value) is value


def test_a_text_is_in_one_line():
    assert csv_cell("a\r=1\nb") == r"a\r=1\nb"


def test_bytes_that_are_no_text_are_escapes():
    assert utf8("größe 表") == "größe 表".encode()
    assert utf8("\udcff\ud800.mcap") == rb"\udcff\ud800.mcap"
    assert escaped("größe \udcff") == r"größe \udcff"
