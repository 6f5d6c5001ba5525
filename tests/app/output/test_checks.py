"""Output files that would replace something else are refused."""

import json
import os
from pathlib import Path

import pytest
from PIL import Image

from app.errors import InputError
from app.exports.figure_size import FigureSize
from app.exports.pictures import png
from app.output.checks import GENERATOR, PAGE, PICTURE, TABLE, OutputKind, check_output
from app.study import page

OURS = {
    TABLE: json.dumps({"parameters": {}, "recordings": [], "means": []}).encode(),
    PICTURE: png(Image.new("RGB", (8, 8)), FigureSize.in_pixels(8, 8), {"Frame": "1"}),
    PAGE: page.page("A study", []).encode(),
}
NAMES = {TABLE: "table", PICTURE: "picture", PAGE: "page"}
each_kind = pytest.mark.parametrize("kind", [TABLE, PICTURE, PAGE], ids=NAMES.values())


@each_kind
def test_what_tofscope_wrote_is_replaced(kind: OutputKind, tmp_path: Path):
    path = tmp_path / f"a{kind.ending}"
    check_output(path, kind)
    for content in (b"", OURS[kind]):
        path.write_bytes(content)
        check_output(path, kind)


@each_kind
@pytest.mark.parametrize(
    "content",
    [
        *(
            b"\x89MCAP0\r\n",
            b"{}",
            b"[1]",
            b"<html></html>",
            b"\x89PNG\r\n\x1a\n",
            b'{"n": 5}',
            b"[",
        ),
        b'{"parameters": {}, "recordings": [1, 2], "means": "mine"}',
        b"<html><p>Made with Tofscope.</p></html>",
        b"<html><p>" + b"My notes. " * 500 + GENERATOR.encode(),
    ],
    ids=range(10),
)
def test_what_it_did_not_write_is_refused(kind: OutputKind, content: bytes, tmp_path: Path):
    path = tmp_path / f"a{kind.ending}"
    path.write_bytes(content)
    with pytest.raises(InputError, match=r"exists and was not made by this command; remove it or"):
        check_output(path, kind)


@each_kind
def test_a_link_to_nothing_makes_no_file(kind: OutputKind, tmp_path: Path):
    path = tmp_path / f"a{kind.ending}"
    path.symlink_to(tmp_path / "precious.txt")
    with pytest.raises(InputError, match="is a link to nothing"):
        check_output(path, kind)


@each_kind
def test_another_ending_is_refused(kind: OutputKind, tmp_path: Path):
    with pytest.raises(InputError, match=rf"a\.mcap must end in \{kind.ending}"):
        check_output(tmp_path / "a.mcap", kind)


@pytest.mark.parametrize("link", [None, os.symlink, os.link])
def test_an_input_or_a_link_to_one_is_refused(link, tmp_path: Path):
    path = read = tmp_path / "a.json"
    read.write_bytes(OURS[TABLE])
    if link:
        path = tmp_path / "b.json"
        link(read, path)
    with pytest.raises(InputError, match="is an input, and would be overwritten; give another"):
        check_output(path, TABLE, [tmp_path / "absent", read])


def test_a_device_may_have_any_name():
    check_output(Path(os.devnull), TABLE, [Path(os.devnull)])
