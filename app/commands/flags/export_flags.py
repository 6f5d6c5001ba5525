"""Flags of `tofscope export`: what is made, what it shows, and how large it is."""

import argparse
import re
from pathlib import Path
from typing import TYPE_CHECKING

from app.errors import InputError
from app.exports.figure_size import DPI, DPIS, MILLIMETRES, PIXELS, FigureSize

if TYPE_CHECKING:
    from app.scene.settings import ViewSettings

VIEWS = ("3d", "top", "front", "robot", "fit")
_COLOURS = ("paper", "colour-blind")
_ARROWS = ("one", "speed", "direction", "cluster")
_SPEED = (0.01, 100.0)
_USUAL = {"screenshot": (1600, 900), "vector": (1600, 900), "video": (1280, 720)}

MADE = {
    "screenshot": ("FILE.png", "a picture of a frame, which needs Chromium"),
    "vector": (
        "FILE.pdf|.svg",
        "the same as a vector drawing, whose text stays text: for print, without Chromium",
    ),
    "video": (
        "FILE.mp4|.gif",
        "all frames, in the recording's own time; needs Chromium, and an .mp4 ffmpeg, too",
    ),
    "images": ("FOLDER", "all frames as PNG pictures in a folder of their own; needs Chromium"),
    "html": ("FILE.html", "all frames as one page, which plays in any browser without network"),
    "flow": (
        "FILE.csv|.npz",
        "every source point: x y z, vx vy vz, label, cluster, sensor, zone",
    ),
    "plots": (
        "FILE.pdf|.svg|.png|.csv",
        "the plots over the whole recording, without Chromium; a .csv holds all their numbers",
    ),
    "clusters": ("FILE.csv", "the clusters of a frame, with every round of ICP"),
}
"""{flag of what is made: (its value, its meaning)}."""

_STILLS, _ANIMATIONS = ("screenshot", "vector"), ("video", "images")
_FIGURES = (*_STILLS, *_ANIMATIONS)
_DRAWN = (*_FIGURES, "html")
_APPLY = {
    "frame": (*_STILLS, "flow", "clusters", "html"),
    "frames": (*_ANIMATIONS, "html", "flow"),
    "view": _DRAWN,
    "dark": _DRAWN,
    "colours": (*_DRAWN, "plots"),
    "arrows": _DRAWN,
    "size": _FIGURES,
    "size_mm": _FIGURES,
    "dpi": ("screenshot", *_ANIMATIONS),
    "transparent": (*_STILLS, "images"),
    "legend": _FIGURES,
    "corner_line": _FIGURES,
    "scale_bar": _FIGURES,
    "speed": ("video",),
}
"""{flag: what it applies to}."""


def add_export_flags(parser: argparse.ArgumentParser) -> None:
    """Add all flags but those of the recording and of the estimate."""
    made = parser.add_argument_group("what to make, one of them")
    what = made.add_mutually_exclusive_group(required=True)
    for name, (value, meaning) in MADE.items():
        what.add_argument(f"--{name}", type=Path, metavar=value, help=meaning)
    shown = parser.add_argument_group("what it shows")
    shown.add_argument(
        "--frame",
        type=int,
        metavar="K",
        help="frame k, of a page the one it begins at (default: one at which something moves)",
    )
    shown.add_argument(
        "--frames",
        type=_range,
        metavar="FIRST:LAST",
        help="frames of a video, of images or of a page (default: all), or of a flow",
    )
    shown.add_argument(
        "--view",
        choices=VIEWS,
        nargs="+",
        help=(
            "how the camera looks: slanted, from above, from the front, from the sensors, or so "
            "that what moves fits; several stand side by side in a picture, such as 3d top, and in "
            "a video the camera moves from one to the next (default 3d)"
        ),
    )
    shown.add_argument(
        "--dark",
        action="store_true",
        help="draw on a dark ground (default: on white, a page on a soft tone)",
    )
    shown.add_argument(
        "--colours",
        choices=_COLOURS,
        help="as in the paper, or such that colour-blind readers can tell them apart",
    )
    shown.add_argument(
        "--arrows",
        choices=_ARROWS,
        help="what the colours of the arrows say (default: nothing, all have one)",
    )
    shown.add_argument("--transparent", action="store_true", help="no background")
    for name, meaning in (
        ("legend", "what the colours mean"),
        ("corner-line", "recording, frame, time, interval, method and parameters"),
        ("scale-bar", "a scale bar and named axes in each view"),
    ):
        shown.add_argument(
            f"--{name}",
            action=argparse.BooleanOptionalAction,
            default=True,
            help=f"with or without {meaning} (default: with)",
        )
    shown.add_argument(
        "--speed",
        type=_Number("a speed", _SPEED),
        metavar="TIMES",
        help="of a video, such as 0.5 for half of real time (default 1)",
    )
    size = parser.add_argument_group("how large it is")
    sizes = size.add_mutually_exclusive_group()
    sizes.add_argument(
        "--size",
        type=_pixels,
        metavar="WIDTHxHEIGHT",
        help="of a view, in pixels (default 1600x900, of a video 1280x720)",
    )
    sizes.add_argument(
        "--size-mm",
        type=_millimetres,
        metavar="WIDTHxHEIGHT",
        help=(
            "of the whole figure, in millimetres, such as 88x62 for a column of a paper; its text "
            "then has 7 points, and points and lines are sized for print"
        ),
    )
    size.add_argument(
        "--dpi",
        type=_Number("a resolution", DPIS),
        metavar="DPI",
        help="pixels per inch of a size in millimetres (default 300)",
    )


def made(options: argparse.Namespace) -> str:
    """What is to be made, one of `MADE`.

    Raises:
        InputError: a flag does not apply to it.
    """
    (kind,) = (name for name in MADE if getattr(options, name) is not None)
    for name, kinds in _APPLY.items():
        negated = name in ("legend", "corner_line", "scale_bar")
        value = getattr(options, name)
        if kind not in kinds and value is not None and value is not negated:
            flag = f"no-{name}" if negated else name
            *others, last = (f"--{other}" for other in kinds)
            named = f"{', '.join(others)} and {last}" if others else last
            raise InputError(
                f"--{flag.replace('_', '-')} applies only to {named}, not to --{kind}; leave it "
                "out."
            )
    if options.dpi is not None and options.size_mm is None:
        raise InputError("--dpi needs a size in millimetres: --size-mm 88x62.")
    if kind == "html" and options.view and len(options.view) > 1:
        raise InputError(f"An offline page has one view, got {len(options.view)}: --view 3d.")
    if kind == "flow" and options.frame is not None and options.frames is not None:
        raise InputError("A flow is of one --frame or of several --frames; leave one out.")
    return kind


def view_names(options: argparse.Namespace) -> tuple[str, ...]:
    """Names of the views, of `app.scene.views.VIEWS`."""
    from app.scene.views import VIEW_FLAGS

    return tuple(VIEW_FLAGS[view] for view in options.view or VIEWS[:1])


def figure_size(options: argparse.Namespace, kind: str) -> FigureSize:
    """Size of a picture, or of each of an animation.

    Raises:
        InputError: it has too many or too few pixels.
    """
    if options.size_mm is None:
        width, height = options.size or _USUAL.get(kind, _USUAL["video"])
        return FigureSize.in_pixels(
            width, height, len(view_names(options)) if kind in _STILLS else 1
        )
    across, down = options.size_mm
    size = FigureSize.in_millimetres(across, down, options.dpi or DPI)
    if kind != "vector":
        size.check()
    return size


def view_settings(options: argparse.Namespace) -> "ViewSettings":
    """Settings of the drawing."""
    from app.scene.palettes import PALETTES
    from app.scene.settings import ARROW_COLOURS, SOFT, TRANSPARENT, WHITE, ViewSettings

    # White is for paper; a page is looked at on a screen, as the app is.
    behind = SOFT if options.dark or options.html is not None else WHITE
    return ViewSettings(
        colours=dict(zip(_COLOURS, PALETTES, strict=True))[options.colours or _COLOURS[0]],
        arrow_colours=dict(zip(_ARROWS, ARROW_COLOURS, strict=True))[options.arrows or _ARROWS[0]],
        dark=options.dark,
        behind=TRANSPARENT if options.transparent else behind,
    )


def _pixels(text: str) -> tuple[int, int]:
    found = re.fullmatch(r"(\d{1,5})x(\d{1,5})", text)
    sides = (int(found[1]), int(found[2])) if found else (0, 0)
    if not all(PIXELS[0] <= side <= PIXELS[1] for side in sides):
        raise argparse.ArgumentTypeError(
            f"a size is written 1600x900, each side from {PIXELS[0]} to {PIXELS[1]}, got {text!r}"
        )
    return sides


def _millimetres(text: str) -> tuple[float, float]:
    number = r"(\d{1,4}(?:\.\d{1,3})?)"
    found = re.fullmatch(f"{number}x{number}", text)
    sides = (float(found[1]), float(found[2])) if found else (0.0, 0.0)
    low, high = MILLIMETRES
    if not all(low <= side <= high for side in sides):
        raise argparse.ArgumentTypeError(
            f"a size in millimetres is written 88x62, each side from {low:g} to {high:g}, "
            f"got {text!r}"
        )
    return sides


class _Number:
    """Type of a flag: a number between two ends."""

    def __init__(self, what: str, ends: tuple[float, float]) -> None:
        self._what, self._ends = what, ends

    def __call__(self, text: str) -> float:
        low, high = self._ends
        try:
            value = float(text)
        except ValueError:
            value = float("nan")
        if not low <= value <= high:
            raise argparse.ArgumentTypeError(
                f"{self._what} is a number from {low:g} to {high:g}, got {text!r}"
            )
        return value


def _range(text: str) -> tuple[int | None, int | None]:
    found = re.fullmatch(r"(\d*):(\d*)", text)
    if not found:
        raise argparse.ArgumentTypeError(
            f"frames are written FIRST:LAST, such as 20:80, got {text!r}"
        )
    first, last = found.groups()
    return (int(first) if first else None, int(last) if last else None)
