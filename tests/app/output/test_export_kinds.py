"""Files of a recording's exports: which are ours, and which would be lost."""

import io
from pathlib import Path

import pytest
from PIL import Image

from app.analysis.estimates import Estimates
from app.errors import InputError
from app.exports.ffmpeg import mp4
from app.exports.figure_notes import figure_sheet
from app.exports.figure_size import FigureSize
from app.exports.flow_file import flow_file, flow_table
from app.exports.pictures import png
from app.output.checks import check_output_of
from app.output.export_kinds import FLOWS, MADE_WITH, VECTORS, VIDEOS
from app.output.image_folder import check_image_folder, write_image_folder
from estimator import Parameters
from tests.app.fake_recordings import fake_opened, fake_recording

KINDS = {**VECTORS, **VIDEOS, **FLOWS}


def ours(ending: str) -> bytes:
    """A file such as the command writes."""
    if ending in FLOWS:
        pair = Estimates().estimated(fake_opened(), 20, Parameters())
        table = flow_table([pair], several=False)
        return flow_file(fake_recording(), Parameters(), table, ending[1:])
    content = io.BytesIO()
    if ending in VECTORS:
        said = MADE_WITH if ending == ".pdf" else [MADE_WITH]
        with figure_sheet(FigureSize.in_pixels(64, 64)) as (figure, _):
            figure.savefig(content, format=ending[1:], metadata={"Creator": said})
        return content.getvalue()
    picture = Image.new("RGB", (64, 64))
    if ending == ".mp4":
        return mp4([(picture, 2)], 30, {"comment": MADE_WITH})
    picture.save(content, "GIF", comment=MADE_WITH.encode())
    return content.getvalue()


@pytest.mark.parametrize("ending", KINDS)
def test_what_tofscope_wrote_is_replaced_and_nothing_else(ending: str, tmp_path: Path):
    path = tmp_path / f"a{ending}"
    check_output_of(path, KINDS)
    path.write_bytes(ours(ending))
    check_output_of(path, KINDS)
    path.write_bytes(b"")
    check_output_of(path, KINDS)
    strange = ours(ending)
    for mark in (MADE_WITH.encode(), b"Tofscope flow", b"made_with_tofscope"):
        strange = strange.replace(mark, b"x" * len(mark))
    for content in (strange, b"x,y\n1,2\n", b"PK\x03\x04", b"%PDF-1.4\n", b"GIF89a", b"\0" * 20):
        path.write_bytes(content)
        with pytest.raises(InputError, match="exists and was not made by this command"):
            check_output_of(path, KINDS)


def test_an_input_and_another_ending_are_refused(tmp_path: Path):
    path = tmp_path / "a.csv"
    path.write_bytes(ours(".csv"))
    with pytest.raises(InputError, match="is an input"):
        check_output_of(path, FLOWS, [path])
    with pytest.raises(InputError, match=r"a\.txt must end in \.csv or \.npz"):
        check_output_of(tmp_path / "a.txt", FLOWS)


def pictures(*numbers: int) -> list[tuple[int, bytes]]:
    size = FigureSize.in_pixels(16, 16)
    return [(number, png(Image.new("RGB", (16, 16)), size, {})) for number in numbers]


def test_a_folder_of_pictures_replaces_only_such_a_folder(tmp_path: Path):
    folder = tmp_path / "out"
    for numbers in ((3, 4, 5), (7,)):
        check_image_folder(folder)
        assert write_image_folder(folder, pictures(*numbers)) == len(numbers)
        names = [path.name for path in sorted(folder.iterdir())]
        assert names == [f"frame_{number:06d}.png" for number in numbers]
    (folder / "notes.txt").write_text("mine")
    with pytest.raises(InputError, match="holds files that were not made by this command"):
        check_image_folder(folder)
    assert [path.name for path in tmp_path.iterdir()] == ["out"]


def test_a_folder_that_cannot_be_made_is_said(tmp_path: Path):
    (tmp_path / "file").write_text("mine")
    (tmp_path / "link").symlink_to(tmp_path / "nothing")
    for name, said in (
        ("file", "is no folder"),
        ("no/out", "there is no folder"),
        ("link", "is a link to nothing"),
    ):
        with pytest.raises(InputError, match=said):
            check_image_folder(tmp_path / name)


def test_pictures_that_fail_leave_the_folder_as_it_was(tmp_path: Path):
    folder = tmp_path / "out"
    write_image_folder(folder, pictures(3))

    def failing():
        yield from pictures(4)
        raise InputError("no more")

    with pytest.raises(InputError, match="no more"):
        write_image_folder(folder, failing())
    assert [path.name for path in folder.iterdir()] == ["frame_000003.png"]
    assert [path.name for path in tmp_path.iterdir()] == ["out"]
