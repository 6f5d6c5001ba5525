"""Commands that save the drawing: pictures, vector drawings and videos."""

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, replace

from app.errors import InputError
from app.exports.animation import Animation
from app.exports.captions import caption
from app.exports.drawn_pair import DrawnPair
from app.exports.ffmpeg import find_ffmpeg
from app.exports.figure_settings import FigureSettings
from app.exports.file_names import safe
from app.exports.images import ZIP, zipped_pictures
from app.exports.pictures import composed, png, view_pixels
from app.exports.vector import vector_figure
from app.exports.video import MP4, video
from app.panels.figure_controls import FigureChoice
from app.scene.corner_line import corner_parts
from app.scene.scene_root import upright
from app.scene.settings import WHITE, ViewSettings
from app.session.command import LatestWins
from app.session.making import Making, delivered, start_making
from app.session.outbox import Download, Message
from app.session.workbench import Workbench

_NO_PICTURE = (
    "The browser gave no picture; bring its tab to the front and try again, or choose a smaller "
    "size."
)
_VIDEO, _VECTOR = "Video", "Vector drawing"


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
        saved, pair, estimates = workbench.saved(), workbench.pair, workbench.estimates
        if saved is None or pair is None:
            return
        figure = _figure(workbench, self.choice)
        settings = _settings(workbench.settings, self.choice)
        frame, picked, compared = workbench.frame, workbench.picked, saved.comparison

        def make(making: Making) -> Sequence[Message]:
            recording, second = making.opened.recording, None
            if compared is not None and compared.both:
                second = estimates.estimated_in_background(making.opened, frame, compared.other)
            drawn = DrawnPair(pair, saved.parameters, compared, second, picked)
            content = vector_figure(recording, drawn, settings, figure, self.kind)
            name = file_name(recording.name, frame, self.choice, self.kind)
            return delivered(_VECTOR, name, content)

        start_making(workbench, _VECTOR, "Drawing.", make)


@dataclass(frozen=True)
class SaveVideo(LatestWins):
    """Save the range that is played as a video, `MP4` or `GIF`, or its pictures as `ZIP`."""

    choice: FigureChoice
    kind: str

    def apply(self, workbench: Workbench) -> None:
        """Start to render it in a headless browser of the server.

        Raises:
            InputError: the size cannot be drawn, another one is being made, or a program is
                missing.
        """
        saved, pair, playback = workbench.saved(), workbench.pair, workbench.clock.playback
        if saved is None:
            return
        if self.kind == MP4:
            find_ffmpeg()
        figure = _figure(workbench, self.choice, beside=False)
        settings = _settings(workbench.settings, self.choice)
        picked = None if pair is None or saved.picked is None else (pair, saved.picked)
        frames = range(playback.first, playback.last + 1)

        def make(making: Making) -> Sequence[Message]:
            animation = Animation(
                making.opened, frames, saved.parameters, settings, figure, saved.comparison, picked
            )

            def progress(index: int) -> None:
                making.step(f"Picture {index + 1} of {len(frames)}.")

            if self.kind == ZIP:
                content = zipped_pictures(animation, making.estimates, progress)
            else:
                content = video(animation, self.kind, playback.speed, making.estimates, progress)
            which = f"frames_{frames[0]:04d}_{frames[-1]:04d}"
            name = f"{safe(making.opened.recording.name)}_{which}.{self.kind}"
            return delivered(_VIDEO, name, content)

        start_making(workbench, _VIDEO, "Drawing frame by frame.", make)


def file_name(recording: str, frame: int, choice: FigureChoice, ending: str) -> str:
    """File name that is safe on every file system."""
    return f"{safe(recording)}_frame_{frame:04d}{safe(choice.file_ending())}.{ending}"


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
    # The person has chosen the picture's background, and not whether the page is dark.
    follows = {"follows_system": before.follows_system}
    workbench.change_view({"dark": wanted.dark, "behind": wanted.behind, **follows})
    try:
        yield
    finally:
        workbench.change_view({"dark": before.dark, "behind": before.behind, **follows})
