"""`tofscope export`: pictures, drawings, videos, pages and flow without an open browser."""

import argparse
from collections.abc import Callable, Iterator, Sequence
from contextlib import closing, contextmanager
from pathlib import Path
from typing import TYPE_CHECKING

from app.commands.export_frames import frame_of, frames_of, frames_text
from app.commands.export_plots import make_clusters, make_plots
from app.commands.flags.engine_flags import add_engine_flag, choose_engine
from app.commands.flags.export_flags import (
    add_export_flags,
    figure_size,
    made,
    view_names,
    view_settings,
)
from app.commands.flags.parameter_flags import add_parameter_flags, parameters_from
from app.commands.flags.recording_flags import add_recording_flags, files_read, opening_from
from app.errors import InputError
from app.output.checks import PAGE, PICTURE, check_output, check_output_of
from app.output.export_kinds import CLUSTERS, FLOWS, PLOTS, VECTORS, VIDEOS
from app.output.image_folder import check_image_folder, write_image_folder
from app.output.writing import write
from app.terminal.bar import Bar
from app.terminal.output import terminal
from estimator import Parameters
from robot_assets.printable import printable

if TYPE_CHECKING:
    from app.analysis.library import Opened
    from app.exports.animation import Animation
    from app.exports.figure_settings import FigureSettings


def add_flags(parser: argparse.ArgumentParser) -> None:
    """Describe the subcommand, and add its flags."""
    parser.description = (
        "Draw a recording as the app does, for print, for talks and for others, or write its "
        "flow as numbers. The files say of themselves which recording they show, and with "
        "which parameters."
    )
    parser.add_argument("path", type=Path, metavar="PATH", help="a recording")
    add_export_flags(parser)
    add_recording_flags(parser)
    add_engine_flag(parser)
    add_parameter_flags(parser)


def run(options: argparse.Namespace) -> int:
    """Run the subcommand."""
    from app.analysis.library import Library

    parameters = parameters_from(options)
    kind = made(options)
    place: Path = getattr(options, kind)
    _check_place(place, kind, [options.path, *files_read(options)])
    if options.path.is_dir():
        raise InputError(f"{options.path} is a folder; name one of the recordings in it.")
    library = Library([options.path], opening_from(options).open)
    entry = library.listing()[0]
    opened = library.open(entry)
    choose_engine(options.engine)
    try:
        said = _MAKERS[kind](place, opened, parameters, options)
    finally:
        library.release(entry)
    print(printable(f"{place}: {said}"))
    return 0


def _check_place(place: Path, kind: str, inputs: list[Path]) -> None:
    """Raise InputError if what is made cannot be written there."""
    if kind == "images":
        check_image_folder(place)
    elif kind in _KINDS:
        check_output_of(place, _KINDS[kind], inputs)
    else:
        check_output(place, PICTURE if kind == "screenshot" else PAGE, inputs)


_KINDS = {
    "vector": VECTORS,
    "video": VIDEOS,
    "flow": FLOWS,
    "plots": PLOTS,
    "clusters": CLUSTERS,
}


def _make_picture(
    place: Path, opened: "Opened", parameters: Parameters, options: argparse.Namespace
) -> str:
    from app.analysis.estimates import Estimates
    from app.exports.drawn_pair import DrawnPair
    from app.exports.picture import picture

    estimates = Estimates()
    frame = frame_of(opened, parameters, options, estimates)
    figure = _figure(options, "screenshot")
    drawn = DrawnPair(estimates.estimated(opened, frame, parameters), parameters)
    write(place, picture(opened, drawn, view_settings(options), figure))
    return f"frame {frame} of {opened.recording.name}, {figure.size.text}."


def _make_vector(
    place: Path, opened: "Opened", parameters: Parameters, options: argparse.Namespace
) -> str:
    from app.analysis.estimates import Estimates
    from app.exports.drawn_pair import DrawnPair
    from app.exports.vector import vector_figure

    estimates = Estimates()
    frame = frame_of(opened, parameters, options, estimates)
    figure, settings = _figure(options, "vector"), view_settings(options)
    drawn = DrawnPair(estimates.estimated(opened, frame, parameters), parameters)
    content = vector_figure(opened.recording, drawn, settings, figure, _ending(place))
    write(place, content)
    return f"frame {frame} of {opened.recording.name}, {_amount(content)}."


def _make_video(
    place: Path, opened: "Opened", parameters: Parameters, options: argparse.Namespace
) -> str:
    from app.analysis.estimates import Estimates
    from app.exports.ffmpeg import find_ffmpeg
    from app.exports.video import MP4, video

    animation, speed = _animation(opened, parameters, options, "video"), options.speed or 1.0
    if _ending(place) == MP4:
        find_ffmpeg()  # before the minutes of rendering
    with _progress(animation.frames) as progress:
        content = video(animation, _ending(place), speed, Estimates(), progress)
    write(place, content)
    seconds = sum(animation.seconds) / speed
    return f"{frames_text(animation.frames, opened)}, {seconds:.1f} s, {_amount(content)}."


def _make_images(
    place: Path, opened: "Opened", parameters: Parameters, options: argparse.Namespace
) -> str:
    from app.analysis.estimates import Estimates
    from app.exports.images import numbered_pictures

    animation = _animation(opened, parameters, options, "images")
    with (
        _progress(animation.frames) as progress,
        closing(numbered_pictures(animation, Estimates(), progress)) as pictures,
    ):
        write_image_folder(place, pictures)
    return f"{frames_text(animation.frames, opened)}, each {animation.figure.size.text}."


def _make_page(
    place: Path, opened: "Opened", parameters: Parameters, options: argparse.Namespace
) -> str:
    from app.analysis.estimates import Estimates
    from app.exports.drawn_pair import DrawnPairs
    from app.exports.offline_page import offline_page

    frames, settings = frames_of(opened, options), view_settings(options)
    view, estimates = view_names(options)[0], Estimates()
    begin = frame_of(opened, parameters, options, estimates)
    if options.frame is not None and begin not in frames:
        raise InputError(f"The page has no frame {begin}: --frames leaves it out.")
    begin = min(max(begin, frames[0]), frames[-1])
    pairs = DrawnPairs(opened, parameters, estimates)
    with _progress(frames) as progress:
        page = offline_page(pairs, frames, begin, settings, view, progress)
    content = page.encode()
    write(place, content)
    return f"{frames_text(frames, opened)}, {_amount(content)}."


def _make_flow(
    place: Path, opened: "Opened", parameters: Parameters, options: argparse.Namespace
) -> str:
    from app.analysis.estimates import Estimates
    from app.exports.flow_file import flow_file, flow_table

    estimates = Estimates()
    if options.frames is None:
        frame = frame_of(opened, parameters, options, estimates)
        frames = range(frame, frame + 1)
    else:
        frames = frames_of(opened, options)
    pairs = (estimates.estimated(opened, k, parameters) for k in frames)
    table = flow_table(pairs, several=options.frames is not None)
    write(place, flow_file(opened.recording, parameters, table, _ending(place)))
    return f"{frames_text(frames, opened)}, {len(table)} points."


def _make_plots(
    place: Path, opened: "Opened", parameters: Parameters, options: argparse.Namespace
) -> str:
    from app.analysis.estimates import Estimates

    colours = view_settings(options).colours
    with _progress(range(len(opened.recording))) as progress:
        return make_plots(place, opened, parameters, colours, Estimates(), progress)


def _make_clusters(
    place: Path, opened: "Opened", parameters: Parameters, options: argparse.Namespace
) -> str:
    from app.analysis.estimates import Estimates

    estimates = Estimates()
    frame = frame_of(opened, parameters, options, estimates)
    return make_clusters(place, opened, parameters, frame, estimates)


_MAKERS: dict[str, Callable[[Path, "Opened", Parameters, argparse.Namespace], str]] = {
    "screenshot": _make_picture,
    "vector": _make_vector,
    "video": _make_video,
    "images": _make_images,
    "html": _make_page,
    "flow": _make_flow,
    "plots": _make_plots,
    "clusters": _make_clusters,
}
"""{what is made: how, which returns what is said of it}."""


def _figure(options: argparse.Namespace, kind: str) -> "FigureSettings":
    from app.exports.figure_settings import FigureSettings

    return FigureSettings(
        figure_size(options, kind),
        view_names(options),
        options.legend,
        options.corner_line,
        options.scale_bar,
    )


def _animation(
    opened: "Opened", parameters: Parameters, options: argparse.Namespace, kind: str
) -> "Animation":
    from app.exports.animation import Animation

    frames, settings = frames_of(opened, options), view_settings(options)
    return Animation(opened, frames, parameters, settings, _figure(options, kind))


@contextmanager
def _progress(frames: Sequence[int]) -> Iterator[Callable[[int], None]]:
    """Context with a function of how many pictures are done, which shows it at a terminal."""
    console = terminal()
    if console is None:
        yield lambda _: None
        return
    bar = Bar(console, len(frames))
    try:
        yield lambda done: bar.show(done, f"frame {frames[done]}")
    finally:
        bar.hide()


def _ending(place: Path) -> str:
    return place.suffix.lower().removeprefix(".")


def _amount(content: bytes) -> str:
    return f"{len(content) / 1e6:.1f} MB"
