"""Animations as MP4 and GIF files."""

import io
import json
from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import closing

from PIL import Image

from app.analysis.estimates import Estimates
from app.exports.animation import Animation
from app.exports.captions import caption
from app.exports.ffmpeg import mp4
from app.output.export_kinds import MADE_WITH
from app.output.text import escaped

MP4, GIF = "mp4", "gif"

_RATES = (30, 60)
"""Pictures per second of an MP4 file: the usual, and for recordings that are faster."""

_TICK = 0.01  # seconds, the unit of a GIF's times
_LEAST_TICKS = 2  # of a picture; browsers slow down faster ones
_COLOURS = 256


def video(
    animation: Animation,
    kind: str,
    speed: float,
    estimates: Estimates,
    progress: Callable[[int], None],
) -> bytes:
    """Render an animation, in the recording's own time, as a file that says what it shows.

    Args:
        animation: to render.
        kind: `MP4` or `GIF`.
        speed: times real time.
        estimates: computes and caches flows.
        progress: called with the number of pictures that are done; an error it raises ends the
            work.

    Raises:
        InputError: Chromium or ffmpeg is missing or fails, or the picture is too small.
        RecordingError: the recording is broken at one of the frames.
    """
    about = _about(animation)
    seconds = [pause / speed for pause in animation.seconds]
    # Where encoding fails, Chromium ends at once, too.
    with closing(animation.pictures(estimates, progress)) as pictures:
        if kind == GIF:
            return _gif(pictures, ticks(seconds), f"{MADE_WITH}. {about}")
        rate = _RATES[len(seconds) > _RATES[0] * sum(seconds)]
        shown = zip(pictures, counts(seconds, rate), strict=True)
        title = escaped(animation.opened.recording.name)
        return mp4(shown, rate, {"title": title, "comment": f"{MADE_WITH}. {about}"})


def counts(seconds: Sequence[float], rate: float) -> list[int]:
    """How often each picture is shown at a constant rate, so that times do not drift."""
    numbers: list[int] = []
    end, shown = 0.0, 0
    for pause in seconds:
        end += pause
        numbers.append(max(round(end * rate) - shown, 0))
        shown += numbers[-1]
    # A very short animation shows its last picture all the same.
    numbers[-1] = max(numbers[-1], 1)
    return numbers


def ticks(seconds: Sequence[float]) -> list[int]:
    """Time of each picture of a GIF in hundredths of a second, so that times do not drift."""
    return [max(number, _LEAST_TICKS) for number in counts(seconds, 1 / _TICK)]


def _gif(pictures: Iterable[Image.Image], times: Sequence[int], comment: str) -> bytes:
    first, *others = _paletted(pictures)
    content = io.BytesIO()
    first.save(
        content,
        "GIF",
        save_all=True,
        append_images=others,
        duration=[round(1000 * _TICK * number) for number in times],
        loop=0,
        comment=comment.encode(),
        optimize=False,
    )
    return content.getvalue()


def _paletted(pictures: Iterable[Image.Image]) -> Iterator[Image.Image]:
    """Pictures of at most 256 colours; they are flat, and need no more."""
    for picture in pictures:
        yield picture.quantize(_COLOURS, Image.Quantize.MEDIANCUT, dither=Image.Dither.NONE)


def _about(animation: Animation) -> str:
    texts = dict(caption(animation.opened.recording, animation.parameters, None, animation.sides))
    texts["Frames"] = f"{animation.frames[0]} to {animation.frames[-1]}"
    return json.dumps(texts, ensure_ascii=False)
