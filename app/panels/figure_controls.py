"""Controls that say how large an exported figure is, and what stands in it."""

from collections.abc import Mapping
from dataclasses import dataclass

import viser

from app.errors import InputError
from app.exports.figure_cameras import FigureView
from app.exports.figure_settings import FigureSettings
from app.exports.figure_size import DPI, DPIS, MILLIMETRES, PIXELS, FigureSize
from app.scene.settings import SOFT, TRANSPARENT, WHITE
from app.scene.views import ABOVE, FRONT, SENSORS, SLANTED

_AS_SHOWN = "As on the screen"
_OWN_PIXELS, _OWN_MILLIMETRES = "Own size, pixels", "Own size, mm"
_PIXELS = {"1280 x 720": (1280, 720), "1600 x 900": (1600, 900), "1920 x 1080": (1920, 1080)}
_MILLIMETRES = {"88 x 62 mm": (88.0, 62.0), "180 x 80 mm": (180.0, 80.0)}
_SIZES = (_AS_SHOWN, *_PIXELS, *_MILLIMETRES, _OWN_PIXELS, _OWN_MILLIMETRES)
_VIEWS: Mapping[str, tuple[str, ...]] = {
    _AS_SHOWN: (),
    f"{SLANTED} and {ABOVE.lower()}": (SLANTED, ABOVE),
    SLANTED: (SLANTED,),
    ABOVE: (ABOVE,),
    FRONT: (FRONT,),
    SENSORS: (SENSORS,),
}
_BACKGROUNDS = {_AS_SHOWN: SOFT, "White": WHITE, "Transparent": TRANSPARENT}


@dataclass(frozen=True)
class FigureChoice:
    """What a person has chosen of a figure.

    Attributes:
        size: one of the sizes in the list.
        own: width and height of an own size, in its unit.
        dpi: pixels per inch of a size in millimetres.
        views: names of views, empty for the one on the screen.
        behind: background, as in `ViewSettings`.
        legend: whether there is a legend.
        corner_line: whether there is a corner line.
        scale: whether there are scale bars and axes.
    """

    size: str
    own: tuple[float, float]
    dpi: float
    views: tuple[str, ...]
    behind: str
    legend: bool
    corner_line: bool
    scale: bool

    def figure(
        self, shown: FigureView, window: tuple[int, int], *, beside: bool = True
    ) -> FigureSettings:
        """The figure.

        Args:
            shown: the view on the screen.
            window: width and height of the scene on the screen, pixels.
            beside: whether several views stand side by side, each of a size in pixels.

        Raises:
            InputError: its size cannot be drawn.
        """
        views = self.views or (shown,)
        size = self._size(window, len(views) if beside else 1)
        size.check()
        return FigureSettings(size, views, self.legend, self.corner_line, self.scale)

    def file_ending(self) -> str:
        """What a file's name says of the views."""
        return "".join(f"_{view.lower().replace(' ', '_')}" for view in self.views)

    def _size(self, window: tuple[int, int], count: int) -> FigureSize:
        if self.size in _MILLIMETRES:
            return FigureSize.in_millimetres(*_MILLIMETRES[self.size], self.dpi)
        width, height = self.own
        if self.size == _OWN_MILLIMETRES:
            _check(self.own, MILLIMETRES, "mm")
            return FigureSize.in_millimetres(width, height, self.dpi)
        if self.size == _OWN_PIXELS:
            _check(self.own, PIXELS, "pixels")
            return FigureSize.in_pixels(round(width), round(height), count)
        across, down = _PIXELS.get(self.size, window)
        return FigureSize.in_pixels(across, down, count)


class FigureControls:
    """Controls of a figure, shared by all that is made of it."""

    def __init__(self, gui: viser.GuiApi) -> None:
        self._size = gui.add_dropdown(
            "Size",
            _SIZES,
            hint="Pixels of each view, or millimetres of the whole figure, whose text has 7 points",
        )
        self._width = gui.add_number("Own width", 1600, min=MILLIMETRES[0], max=PIXELS[1])
        self._height = gui.add_number("Own height", 900, min=MILLIMETRES[0], max=PIXELS[1])
        self._dpi = gui.add_number(
            "dpi", DPI, min=DPIS[0], max=DPIS[1], hint="Pixels per inch of a size in millimetres"
        )
        self._views = gui.add_dropdown(
            "Views",
            tuple(_VIEWS),
            hint="Several stand side by side; in a video the camera moves from one to the next",
        )
        self._background = gui.add_dropdown("Background", tuple(_BACKGROUNDS))
        self._legend = gui.add_checkbox("With legend", True)
        self._corner_line = gui.add_checkbox(
            "With corner line", True, hint="Recording, frame, time, interval, parameters"
        )
        self._scale = gui.add_checkbox("With scale bar", True, hint="And with named axes")

    def chosen(self) -> FigureChoice:
        """What is chosen now; what a browser sends beside it counts as the first choice."""
        dpi = min(max(float(self._dpi.value), DPIS[0]), DPIS[1])
        return FigureChoice(
            self._size.value,
            (float(self._width.value), float(self._height.value)),
            dpi,
            _VIEWS.get(self._views.value, ()),
            _BACKGROUNDS.get(self._background.value, SOFT),
            bool(self._legend.value),
            bool(self._corner_line.value),
            bool(self._scale.value),
        )


def _check(sides: tuple[float, float], ends: tuple[float, float], unit: str) -> None:
    if not all(ends[0] <= side <= ends[1] for side in sides):
        raise InputError(
            f"The own width and height must be {ends[0]:g} to {ends[1]:g} {unit}, "
            f"got {sides[0]:g} x {sides[1]:g}."
        )
