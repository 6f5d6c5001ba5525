"""Commands that save the drawing: pictures, vector drawings and videos."""

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, replace

from app.analysis.estimates import Estimates
from app.analysis.library import Library
from app.errors import InputError
from app.exports.animation import Animation
from app.exports.captions import caption
from app.exports.drawn_pair import DrawnPair
from app.exports.ffmpeg import find_ffmpeg
from app.exports.figure_settings import FigureSettings
from app.exports.file_names import safe
from app.exports.pictures import composed, png, view_pixels
from app.exports.vector import vector_figure
from app.exports.video import MP4, video
from app.panels.figure_controls import FigureChoice
from app.scene.corner_line import corner_parts
from app.scene.scene_root import upright
from app.scene.settings import WHITE, ViewSettings
from app.session.command import LatestWins
from app.session.outbox import Download, Message, Notice
from app.session.tasks import Report
from app.session.workbench import Workbench

_NO_PICTURE = (
    "The browser gave no picture; bring its tab to the front and try again, or choose a smaller "
    "size."
)
_VIDEO, _VECTOR = "Video", "Vector drawing"
_QUIET = 0.02  # seconds without foreground work before the next frame
_PATIENCE = 0.5  # seconds after which it continues in any case


@dataclass(frozen=True)
class SavePicture(LatestWins):
    """Save the drawing as a PNG file, rendered by the user's browser."""

    choice: FigureChoice

    def apply(self, workbench: Workbench) -> None:
        """Render the views, and put the file into the outbox.

        Raises:
            InputError: the size cannot be drawn, or the browser returned no picture.
        """
        opened, pair, tuning = workbench.opened, workbench.pair, workbench.tuning
        if opened is None:
            return
        if pair is None:
            raise InputError(_NO_PICTURE)
        recording, compared = opened.recording, tuning.comparison
        sides = compared.drawn(tuning.parameters) if compared else {}
        line = corner_parts(recording, workbench.frame, pair, tuning.parameters, sides)
        try:
            figure = _figure(workbench, self.choice)
            with _drawn_for(workbench, self.choice):
                settings = workbench.settings
                notes, layout = figure.laid_out(workbench.scene.legend, line, settings)
                width, height = view_pixels(figure.size, layout)
                cameras = figure.cameras(recording, [pair], layout)
                render, detail = workbench.renderer.render, figure.size.detail
                taken = [render(camera, width, height, detail) for camera in cameras]
        except (RuntimeError, TimeoutError) as error:
            raise InputError(_NO_PICTURE) from error
        background, turn = figure.background(settings), upright(recording.fixed_frame)
        picture = composed(taken, figure.size, layout, background, notes, cameras, turn)
        text = caption(recording, tuning.parameters, workbench.frame, sides)
        name = file_name(recording.name, workbench.frame, self.choice, "png")
        workbench.outbox.append(Download(name, png(picture, figure.size, text)))


@dataclass(frozen=True)
class SaveVector(LatestWins):
    """Save the drawing as a vector file, `PDF` or `SVG`."""

    choice: FigureChoice
    kind: str

    def apply(self, workbench: Workbench) -> None:
        """Start to draw it in the background.

        Raises:
            InputError: the size cannot be drawn, or another one is being drawn.
        """
        saved, library, pair = workbench.saved(), workbench.library, workbench.pair
        if workbench.opened is None or saved is None or pair is None:
            return
        if workbench.tasks.running(_VECTOR):
            raise InputError("A vector drawing is being made already; wait until it is there.")
        figure, compared = _figure(workbench, self.choice), saved.comparison
        settings = _settings(workbench.settings, self.choice)
        estimates, frame, picked = workbench.estimates, workbench.frame, workbench.picked
        opened = library.open(workbench.opened.entry)

        def make(_: Report) -> Sequence[Message]:
            try:
                drawn = DrawnPair(pair, picked=picked)
                if compared is not None and compared.both:
                    second = estimates.estimated_in_background(opened, frame, compared.other)
                    drawn = replace(drawn, second=second, side=compared.edited)
                content = vector_figure(
                    opened.recording, drawn, saved.parameters, settings, figure, self.kind
                )
            finally:
                library.release(opened.entry)
            name = file_name(opened.recording.name, frame, self.choice, self.kind)
            return _delivered(_VECTOR, name, content)

        workbench.tasks.start(_VECTOR, "Drawing.", make)


@dataclass(frozen=True)
class SaveVideo(LatestWins):
    """Save the range that is played as a video, `MP4` or `GIF`."""

    choice: FigureChoice
    kind: str

    def apply(self, workbench: Workbench) -> None:
        """Start to render it in a headless browser of the server.

        Raises:
            InputError: the size cannot be drawn, another one is being made, or a program is
                missing.
        """
        saved, library, estimates = workbench.saved(), workbench.library, workbench.estimates
        if workbench.opened is None or saved is None or saved.playback is None:
            return
        if workbench.tasks.running(_VIDEO):
            raise InputError("A video is being made already; wait until it is there.")
        if self.kind == MP4:
            find_ffmpeg()
        figure = _figure(workbench, self.choice, beside=False)
        settings = _settings(workbench.settings, self.choice)
        playback = saved.playback
        opened = library.open(workbench.opened.entry)
        frames = range(playback.first, playback.last + 1)
        animation = Animation(opened, frames, saved.parameters, settings, figure)
        workbench.tasks.start(
            _VIDEO,
            "Drawing frame by frame.",
            lambda report: _make_video(
                animation, self.kind, playback.speed, library, estimates, report
            ),
        )


def file_name(recording: str, frame: int, choice: FigureChoice, ending: str) -> str:
    """File name that is safe on every file system."""
    return f"{safe(recording)}_frame_{frame:04d}{safe(choice.file_ending())}.{ending}"


def _make_video(
    animation: Animation,
    kind: str,
    speed: float,
    library: Library,
    estimates: Estimates,
    report: Report,
) -> Sequence[Message]:
    count = len(animation.frames)

    def progress(index: int) -> None:
        estimates.foreground.wait_until_quiet(_QUIET, _PATIENCE)
        report(f"Picture {index + 1} of {count}.")

    try:
        content = video(animation, kind, speed, estimates, progress)
    finally:
        library.release(animation.opened.entry)
    return _delivered(_VIDEO, f"{safe(animation.opened.recording.name)}.{kind}", content)


def _delivered(title: str, name: str, content: bytes) -> Sequence[Message]:
    sentence = f"{name}, {len(content) / 1e6:.1f} MB, is in your downloads."
    return Download(name, content), Notice(title, sentence, "green", seconds=10.0)


def _figure(workbench: Workbench, choice: FigureChoice, *, beside: bool = True) -> FigureSettings:
    shown = workbench.scene.camera()
    return choice.figure(shown, workbench.renderer.size(), beside=beside)


def _settings(settings: ViewSettings, choice: FigureChoice) -> ViewSettings:
    # A dark page's colours are too pale on white.
    dark = settings.dark and choice.behind != WHITE
    return replace(settings, behind=choice.behind, dark=dark)


@contextmanager
def _drawn_for(workbench: Workbench, choice: FigureChoice) -> Iterator[None]:
    """Context in which the scene is drawn as a choice of background wants it."""
    before = workbench.settings
    wanted = _settings(before, choice)
    workbench.change_view({"dark": wanted.dark, "behind": wanted.behind})
    try:
        yield
    finally:
        workbench.change_view({"dark": before.dark, "behind": before.behind})
