"""Pictures of a range of frames, rendered one after the other in one headless browser."""

from collections.abc import Callable, Generator, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np
from PIL import Image

from app.analysis.comparison import Comparison
from app.analysis.estimates import Estimates
from app.analysis.library import Opened
from app.analysis.pairs import Pair
from app.exports.drawn_pair import DrawnPair, DrawnPairs
from app.exports.figure_settings import FigureSettings, corner_parts_of
from app.exports.headless import headless_scene
from app.exports.key_views import camera_between, key_times
from app.exports.pictures import composed, view_pixels
from app.scene.scene_root import upright
from app.scene.settings import ViewSettings
from estimator import Parameters

_SAMPLES = 12
"""Frames that say how large the views and the texts of all must be."""


@dataclass(frozen=True)
class Animation:
    """What an animation shows.

    Attributes:
        opened: the recording.
        frames: k of each picture, increasing; at least one.
        parameters: of the estimate.
        settings: of the drawing.
        figure: of each picture. Its views are no neighbours: the camera moves from one to the next.
        comparison: with other parameters, whose flow is drawn too if its `both` is set.
        picked: pair and index of a picked cluster, which is followed; None for none.
    """

    opened: Opened
    frames: Sequence[int]
    parameters: Parameters
    settings: ViewSettings
    figure: FigureSettings
    comparison: Comparison | None = None
    picked: tuple[Pair, int] | None = None

    @property
    def sides(self) -> Mapping[str, Parameters]:
        """{A or B: its parameters} where the flow of both is drawn, else empty."""
        return self.comparison.drawn(self.parameters) if self.comparison else {}

    @property
    def seconds(self) -> list[float]:
        """Time from each picture's stamp to the next one's; the last has the usual."""
        stamps = self.opened.recording.stamps
        pauses = np.diff(stamps[list(self.frames)])
        usual = float(np.median(pauses)) if len(pauses) else 1.0
        return [*map(float, pauses), usual]

    def pictures(
        self, estimates: Estimates, progress: Callable[[int], None]
    ) -> Generator[Image.Image, None, None]:
        """Render one picture after the other; close it where it is left early.

        Args:
            estimates: computes and caches flows.
            progress: called with the number of pictures that are done; an error it raises ends
                the work.

        Raises:
            InputError: a picture is too small for its texts, or Chromium is missing or gives none.
            RecordingError: the recording is broken at one of the frames.
        """
        recording = self.opened.recording
        figure = replace(self.figure, views=self.figure.views[:1])
        samples = self._samples(estimates)
        strip = max(
            figure.planned(recording, drawn, self.settings)[1].strip.height for drawn in samples
        )
        _, layout = figure.planned(recording, samples[0], self.settings, strip)
        width, height = view_pixels(figure.size, layout)
        keys = self.figure.cameras(recording, [drawn.pair for drawn in samples], layout)
        background = figure.background(self.settings)
        turn = upright(recording.fixed_frame)
        with headless_scene(recording, self.settings, width, height, figure.size.detail) as scene:
            pairs, times = self._drawn(estimates), key_times(len(self.frames))
            for index, (k, part) in enumerate(zip(self.frames, times, strict=True)):
                progress(index)
                drawn = pairs.at(k)
                camera = camera_between(keys, part)
                scene.show(drawn)
                pixels = scene.rendered(camera) if index else scene.settled(camera)
                line = corner_parts_of(recording, drawn)
                notes, its_layout = figure.laid_out(scene.legend, line, self.settings, strip)
                # A rare line more must not move the scene.
                its_layout = replace(its_layout, views=layout.views)
                yield composed([pixels], figure.size, its_layout, background, notes, [camera], turn)

    def _drawn(self, estimates: Estimates) -> DrawnPairs:
        return DrawnPairs(self.opened, self.parameters, estimates, self.comparison, self.picked)

    def _samples(self, estimates: Estimates) -> list[DrawnPair]:
        """Pairs of some frames, evenly spread, the first and the last among them."""
        places = np.linspace(0, len(self.frames) - 1, min(_SAMPLES, len(self.frames)))
        pairs = self._drawn(estimates)
        return [
            pairs.at(self.frames[place])
            for place in dict.fromkeys(places.round().astype(int).tolist())
        ]
