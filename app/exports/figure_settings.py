"""What a person chooses of a figure: its size, its views, and what stands beside them."""

from collections.abc import Sequence
from dataclasses import dataclass, replace

from app.analysis.pairs import Pair
from app.errors import InputError
from app.exports.drawn_pair import DrawnPair
from app.exports.figure_cameras import FigureView, figure_camera
from app.exports.figure_layout import FigureLayout, figure_layout
from app.exports.figure_notes import SCALE_HEIGHT, FigureNotes
from app.exports.figure_size import FigureSize
from app.scene.camera import Camera
from app.scene.colours import Colour
from app.scene.corner_line import corner_parts
from app.scene.drawn_clouds import as_drawn, something_moves
from app.scene.legend import Legend
from app.scene.settings import TRANSPARENT, ViewSettings
from recordings import Recording


@dataclass(frozen=True)
class FigureSettings:
    """Size, views and notes of a figure.

    Attributes:
        size: of the whole figure.
        views: placed side by side.
        legend: whether it says what the colours mean.
        corner_line: whether it says recording, frame, time, interval, method and parameters.
        scale: whether each view has a scale bar and named axes.
    """

    size: FigureSize
    views: tuple[FigureView, ...]
    legend: bool = True
    corner_line: bool = True
    scale: bool = True

    def planned(
        self,
        recording: Recording,
        drawn: DrawnPair,
        settings: ViewSettings,
        strip: float = 0.0,
    ) -> tuple[FigureNotes, FigureLayout]:
        """The notes of a pair's figure, and where all is in it.

        Args:
            recording: of the pair.
            drawn: the pair, and what is shown with it.
            settings: of the drawing.
            strip: least height of the texts below the views, points.

        Raises:
            InputError: the figure is too small for its texts.
        """
        seen = as_drawn(settings, something_moves(drawn.pair))
        line = corner_parts_of(recording, drawn)
        return self.laid_out(drawn.legend(seen), line, settings, strip)

    def laid_out(
        self, drawn: Legend, line: tuple[str, ...], settings: ViewSettings, strip: float = 0.0
    ) -> tuple[FigureNotes, FigureLayout]:
        """The notes with this legend and corner line, as far as they are wanted, and the layout.

        A picture in pixels that is too small for them, such as a thumbnail, has none.

        Raises:
            InputError: a printed figure is too small for its texts.
        """
        notes = FigureNotes(
            drawn if self.legend else None,
            line if self.corner_line else (),
            self.scale,
            settings.dark,
            self.background(settings),
        )
        try:
            return notes, self._layout(notes, strip)
        except InputError:
            if self.size.printed:
                raise
        notes = replace(notes, legend=None, corner_line=())
        return notes, self._layout(notes, strip)

    def _layout(self, notes: FigureNotes, strip: float) -> FigureLayout:
        return figure_layout(self.size, len(self.views), notes.legend, notes.corner_line, strip)

    def cameras(
        self, recording: Recording, pairs: Sequence[Pair], layout: FigureLayout
    ) -> tuple[Camera, ...]:
        """The camera of each view.

        Args:
            recording: of the pairs.
            pairs: to be shown, at least one; several are those of an animation.
            layout: of the figure.
        """
        box = layout.views[0]
        free = SCALE_HEIGHT / box.height if self.scale else 0.0
        return tuple(
            figure_camera(recording, pairs, view, box.width / box.height, free)
            for view in self.views
        )

    def background(self, settings: ViewSettings) -> Colour | None:
        """Colour of the ground, None for none."""
        return None if settings.behind == TRANSPARENT else settings.background


def corner_parts_of(recording: Recording, drawn: DrawnPair) -> tuple[str, ...]:
    """Parts of the corner line of a drawn pair."""
    pair = drawn.pair
    return corner_parts(recording, pair.frame, pair, drawn.parameters, drawn.sides)
