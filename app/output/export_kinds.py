"""Kinds of files that `tofscope export` writes, beside pictures and pages."""

import zipfile
from pathlib import Path

from app.output.checks import PICTURE, OutputKind

MADE_WITH = "Made with Tofscope"
"""Words in the description of a file, by which it is known as Tofscope's."""

FLOW_HEADING = "Tofscope flow"
"""Beginning of a flow's CSV file, after the comment sign."""

PLOTS_HEADING = "Tofscope"
"""Beginning of the plots' CSV file, after the comment sign; and the creator of their pictures."""

CLUSTERS_HEADING = "Tofscope clusters"
"""Beginning of a CSV file with clusters, after the comment sign."""

FLOW_MARK = "made_with_tofscope"
"""Name of an array in a flow's NPZ file."""


def _holds(path: Path, beginning: bytes, words: str = MADE_WITH) -> bool:
    """Whether a file begins so, and says that it was made with Tofscope."""
    content = path.read_bytes()
    return content[: len(beginning)] == beginning and words.encode() in content


def _is_pdf(path: Path) -> bool:
    return _holds(path, b"%PDF-")


def _is_svg(path: Path) -> bool:
    return _holds(path, b"<?xml")


def _is_mp4(path: Path) -> bool:
    return _holds(path, path.read_bytes()[:4] + b"ftyp")


def _is_gif(path: Path) -> bool:
    from PIL import Image, UnidentifiedImageError

    try:
        with Image.open(path) as picture:
            comment = picture.info.get("comment", b"")
            return picture.format == "GIF" and MADE_WITH.encode() in comment
    except (UnidentifiedImageError, Image.DecompressionBombError):
        return False


def _begins(path: Path, comment: str) -> bool:
    """Whether a file begins with this comment."""
    beginning = f"# {comment}".encode()
    with path.open("rb") as table:
        return table.read(len(beginning)) == beginning


def _is_flow_csv(path: Path) -> bool:
    return _begins(path, f"{FLOW_HEADING};")


def _is_flow_npz(path: Path) -> bool:
    try:
        with zipfile.ZipFile(path) as archive:
            return f"{FLOW_MARK}.npy" in archive.namelist()
    except zipfile.BadZipFile:
        return False


VECTORS = {kind.ending: kind for kind in (OutputKind(".pdf", _is_pdf), OutputKind(".svg", _is_svg))}
"""`tofscope export --vector`."""

VIDEOS = {kind.ending: kind for kind in (OutputKind(".mp4", _is_mp4), OutputKind(".gif", _is_gif))}
"""`tofscope export --video`."""

FLOWS = {
    kind.ending: kind
    for kind in (OutputKind(".csv", _is_flow_csv), OutputKind(".npz", _is_flow_npz))
}
"""`tofscope export --flow`."""

PLOTS = {
    kind.ending: kind
    for kind in (
        OutputKind(".pdf", lambda path: _holds(path, b"%PDF-", PLOTS_HEADING)),
        OutputKind(".svg", lambda path: _holds(path, b"<?xml", PLOTS_HEADING)),
        PICTURE,
        OutputKind(".csv", lambda path: _begins(path, f"{PLOTS_HEADING};")),
    )
}
"""`tofscope export --plots`."""

CLUSTERS = {".csv": OutputKind(".csv", lambda path: _begins(path, f"{CLUSTERS_HEADING} "))}
"""`tofscope export --clusters`."""
