"""Pictures of a range of frames, rendered one after the other in one headless browser."""

from collections.abc import Callable, Generator, Sequence
from dataclasses import dataclass, replace

import numpy as np
from PIL import Image

from app.analysis.estimates import Estimates
from app.analysis.library import Opened
from app.analysis.pairs import Pair
from app.exports.figure_settings import FigureSettings
from app.exports.headless import headless_scene
from app.exports.key_views import camera_between, key_times
from app.exports.pictures import composed, view_pixels
from app.scene.corner_line import corner_parts
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
    """

    opened: Opened
    frames: Sequence[int]
    parameters: Parameters
    settings: ViewSettings
    figure: FigureSettings

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
            figure.planned(recording, pair, self.parameters, self.settings)[1].strip.height
            for pair in samples
        )
        _, layout = figure.planned(recording, samples[0], self.parameters, self.settings, strip)
        width, height = view_pixels(figure.size, layout)
        keys = self.figure.cameras(recording, samples, layout)
        background = figure.background(self.settings)
        turn = upright(recording.fixed_frame)
        with headless_scene(recording, self.settings, width, height, figure.size.detail) as scene:
            times = key_times(len(self.frames))
            for index, (k, part) in enumerate(zip(self.frames, times, strict=True)):
                progress(index)
                pair = estimates.estimated_in_background(self.opened, k, self.parameters)
                camera = camera_between(keys, part)
                scene.show(pair)
                pixels = scene.rendered(camera) if index else scene.settled(camera)
                line = corner_parts(recording, k, pair, self.parameters)
                notes, its_layout = figure.laid_out(scene.legend, line, self.settings, strip)
                # A rare line more must not move the scene.
                its_layout = replace(its_layout, views=layout.views)
                yield composed([pixels], figure.size, its_layout, background, notes, [camera], turn)

    def _samples(self, estimates: Estimates) -> list[Pair]:
        """Pairs of some frames, evenly spread, the first and the last among them."""
        places = np.linspace(0, len(self.frames) - 1, min(_SAMPLES, len(self.frames)))
        return [
            estimates.estimated_in_background(self.opened, self.frames[place], self.parameters)
            for place in dict.fromkeys(places.round().astype(int).tolist())
        ]
