"""Animations as numbered PNG pictures, each of which says what it shows."""

import io
import zipfile
from collections.abc import Callable, Generator
from contextlib import closing

from app.analysis.estimates import Estimates
from app.exports.animation import Animation
from app.exports.captions import caption
from app.exports.pictures import png
from app.output.image_folder import image_name

ZIP = "zip"


def numbered_pictures(
    animation: Animation, estimates: Estimates, progress: Callable[[int], None]
) -> Generator[tuple[int, bytes], None, None]:
    """Frame k and PNG file of each picture, rendered one after the other.

    Args:
        animation: to render.
        estimates: computes and caches flows.
        progress: called with the number of pictures that are done; an error it raises ends the
            work.

    Raises:
        InputError: Chromium is missing or fails, or the picture is too small.
        RecordingError: the recording is broken at one of the frames.
    """
    recording, parameters = animation.opened.recording, animation.parameters
    with closing(animation.pictures(estimates, progress)) as pictures:
        for k, picture in zip(animation.frames, pictures, strict=True):
            text = caption(recording, parameters, k, animation.sides)
            yield k, png(picture, animation.figure.size, text)


def zipped_pictures(
    animation: Animation, estimates: Estimates, progress: Callable[[int], None]
) -> bytes:
    """The numbered pictures as a ZIP file, for a browser, which saves no folders."""
    content = io.BytesIO()
    # PNG is compressed already.
    with (
        zipfile.ZipFile(content, "w", zipfile.ZIP_STORED) as archive,
        closing(numbered_pictures(animation, estimates, progress)) as pictures,
    ):
        for k, picture in pictures:
            archive.writestr(zipfile.ZipInfo(image_name(k)), picture)
    return content.getvalue()
