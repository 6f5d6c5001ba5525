"""`tofscope export`: pictures and offline pages without an open browser."""

import argparse
import re
from pathlib import Path
from typing import TYPE_CHECKING

from app.commands.flags.parameter_flags import add_parameter_flags, parameters_from
from app.commands.flags.recording_flags import add_recording_flags, files_read, opening_from
from app.errors import InputError
from app.output.checks import PAGE, PICTURE, check_output
from app.output.writing import write
from estimator import Parameters
from robot_assets.printable import printable

if TYPE_CHECKING:
    from app.analysis.library import Opened
    from app.scene.settings import ViewSettings

_VIEWS = ("3d", "top", "front", "robot", "fit")
_COLOURS = ("paper", "colour-blind")
_ARROWS = ("one", "speed", "direction", "cluster")
_SIDE = (16, 4096)  # pixels; larger ones, drawn in software, take minutes


def add_parser(commands: argparse._SubParsersAction) -> None:
    """Add the subcommand."""
    parser = commands.add_parser(
        "export",
        help="make a picture or an offline page of a recording",
        description=(
            "Draw a recording as the app does: a frame as a PNG picture, which needs Chromium, "
            "or all frames as one HTML page, which plays in any browser without network. The "
            "files say of themselves which recording they show, and with which parameters."
        ),
    )
    parser.add_argument("path", type=Path, metavar="PATH", help="a recording")
    what = parser.add_mutually_exclusive_group(required=True)
    what.add_argument("--screenshot", type=Path, metavar="FILE.png", help="make a picture")
    what.add_argument("--html", type=Path, metavar="FILE.html", help="make an offline page")
    parser.add_argument(
        "--view",
        choices=_VIEWS,
        nargs="+",
        default=["3d"],
        help=(
            "where the camera stands: at a slant, above, before the robot, on its skin, or far "
            "enough to see everything; several stand side by side in a picture, such as 3d top "
            "(default 3d)"
        ),
    )
    parser.add_argument("--dark", action="store_true", help="draw on black (default: on white)")
    parser.add_argument(
        "--colours",
        choices=_COLOURS,
        default=_COLOURS[0],
        help="as in the paper, or such that colour-blind readers can tell them apart",
    )
    parser.add_argument(
        "--arrows",
        choices=_ARROWS,
        default=_ARROWS[0],
        help="what the colours of the arrows say (default: nothing, all have one)",
    )
    picture = parser.add_argument_group("a picture")
    picture.add_argument(
        "--frame", type=int, metavar="K", help="frame k (default: one at which something moves)"
    )
    picture.add_argument(
        "--size",
        type=_size,
        metavar="WIDTHxHEIGHT",
        help="of a view, in pixels (default 1600x900)",
    )
    picture.add_argument("--transparent", action="store_true", help="no background")
    picture.add_argument(
        "--legend", action="store_true", help="say in the picture what the colours mean"
    )
    page = parser.add_argument_group("an offline page")
    page.add_argument(
        "--frames", type=_range, metavar="FIRST:LAST", help="frames that it plays (default: all)"
    )
    add_recording_flags(parser)
    add_parameter_flags(parser)
    parser.set_defaults(run=run)


def run(options: argparse.Namespace) -> int:
    """Run the subcommand."""
    from app.analysis.library import Library

    parameters = parameters_from(options)
    _check_flags(options)
    place, kind = (options.screenshot, PICTURE) if options.screenshot else (options.html, PAGE)
    check_output(place, kind, [options.path, *files_read(options)])
    if options.path.is_dir():
        raise InputError(f"{options.path} is a folder; name one of the recordings in it.")
    library = Library([options.path], opening_from(options).open)
    entry = library.listing()[0]
    opened = library.open(entry)
    try:
        if options.screenshot:
            _export_picture(opened, parameters, options)
        else:
            _export_page(opened, parameters, options)
    finally:
        library.release(entry)
    return 0


def _export_picture(opened: "Opened", parameters: Parameters, options: argparse.Namespace) -> None:
    from app.analysis.estimates import Estimates
    from app.analysis.first_frame import first_frame_with_flow
    from app.exports.picture import PictureSettings, picture

    estimates, frame = Estimates(), options.frame
    if frame is None:
        frame = first_frame_with_flow(opened, parameters, estimates)
    _check_frame(opened, frame)
    width, height = options.size or (1600, 900)
    pair = estimates.estimated(opened, frame, parameters)
    views = _views(options)
    framing = PictureSettings(width, height, views, options.transparent, options.legend)
    content = picture(opened, pair, parameters, _settings(options), framing)
    write(options.screenshot, content)
    print(
        printable(
            f"{options.screenshot}: frame {frame} of {opened.recording.name}, "
            f"{width * len(views)} x {height}."
        )
    )


def _export_page(opened: "Opened", parameters: Parameters, options: argparse.Namespace) -> None:
    from app.analysis.estimates import Estimates
    from app.exports.offline_page import offline_page

    first, last = options.frames or (None, None)
    first = 0 if first is None else first
    last = len(opened.recording) - 1 if last is None else last
    _check_frame(opened, first)
    _check_frame(opened, last)
    if first > last:
        raise InputError(f"The last frame must not be before the first; got {first}:{last}.")
    frames = range(first, last + 1)
    page = offline_page(
        opened,
        frames,
        parameters,
        _settings(options),
        _views(options)[0],
        Estimates(),
        lambda _: None,
    )
    content = page.encode()
    write(options.html, content)
    print(
        printable(
            f"{options.html}: frames {first} to {last} of {opened.recording.name}, "
            f"{len(content) / 1e6:.1f} MB."
        )
    )


def _views(options: argparse.Namespace) -> tuple[str, ...]:
    from app.scene.views import VIEWS

    names = {view.lower(): view for view in VIEWS}
    return tuple(names[view] for view in options.view)


def _settings(options: argparse.Namespace) -> "ViewSettings":
    from app.scene.palettes import PALETTES
    from app.scene.settings import ARROW_COLOURS, ViewSettings

    return ViewSettings(
        colours=dict(zip(_COLOURS, PALETTES, strict=True))[options.colours],
        arrow_colours=dict(zip(_ARROWS, ARROW_COLOURS, strict=True))[options.arrows],
        dark=options.dark,
    )


def _check_flags(options: argparse.Namespace) -> None:
    """Raise InputError for a flag that does not apply to the kind of export."""
    if options.html and len(options.view) > 1:
        raise InputError(f"An offline page has one view, got {len(options.view)}: --view 3d.")
    made, other, others = (
        ("--screenshot", "--html", ("frames",))
        if options.screenshot
        else ("--html", "--screenshot", ("frame", "size", "transparent", "legend"))
    )
    for name in others:
        if getattr(options, name) not in (None, False):
            raise InputError(f"--{name} applies only to {other}, not to {made}; leave it out.")


def _check_frame(opened: "Opened", frame: int) -> None:
    last = len(opened.recording) - 1
    if not 0 <= frame <= last:
        raise InputError(
            f"{opened.recording.name} has no frame {frame}: its frames are 0 to {last}."
        )


def _size(text: str) -> tuple[int, int]:
    found = re.fullmatch(r"(\d{1,5})x(\d{1,5})", text)
    sides = (int(found[1]), int(found[2])) if found else (0, 0)
    if not all(_SIDE[0] <= side <= _SIDE[1] for side in sides):
        raise argparse.ArgumentTypeError(
            f"a size is written 1600x900, each side from {_SIDE[0]} to {_SIDE[1]}, got {text!r}"
        )
    return sides


def _range(text: str) -> tuple[int | None, int | None]:
    found = re.fullmatch(r"(\d*):(\d*)", text)
    if not found:
        raise argparse.ArgumentTypeError(
            f"frames are written FIRST:LAST, such as 20:80, got {text!r}"
        )
    first, last = found.groups()
    return (int(first) if first else None, int(last) if last else None)
