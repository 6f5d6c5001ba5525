"""Composition of rendered scenes into PNG files, with background, legend and caption."""

import io
from collections.abc import Mapping, Sequence

import numpy as np
from numpy.typing import NDArray
from PIL import Image, ImageDraw, ImageFont
from PIL.PngImagePlugin import PngInfo

from app.scene.colours import Colour
from app.scene.legend import Legend
from app.scene.palettes import blend

_TEXT = 1 / 52  # height of the legend's text, as a fraction of the picture's height
_DARK_INK, _LIGHT_INK = (38, 40, 44, 255), (230, 231, 234, 255)
_DARK_GROUND, _LIGHT_GROUND = (28, 29, 32, 205), (255, 255, 255, 217)


def picture_file(
    views: Sequence[NDArray[np.uint8]],
    background: Colour | None,
    legend: Legend | None,
    caption: Mapping[str, str],
) -> bytes:
    """PNG file of rendered views side by side.

    Args:
        views: pixels (H, W, 4) of each, transparent where nothing is drawn.
        background: colour, None to keep it transparent.
        legend: for the first view, None for none.
        caption: {name: value}, the file's text.
    """
    first, *others = views
    pictures = [composed(first, background, legend)]
    pictures += [composed(pixels, background, None) for pixels in others]
    return png(side_by_side(pictures), caption)


def composed(
    pixels: NDArray[np.uint8], background: Colour | None, legend: Legend | None
) -> Image.Image:
    """Compose a rendered image with its background and legend.

    Args:
        pixels: (H, W, 4), transparent where nothing is drawn.
        background: colour, None to keep it transparent.
        legend: for the lower left corner, None for none.
    """
    picture = Image.fromarray(pixels).convert("RGBA")
    if background is not None:
        ground = Image.new("RGBA", picture.size, background)
        ground.alpha_composite(picture)
        picture = ground
    if legend is not None:
        dark = legend.dark if background is None else sum(background) < 3 * 128
        _draw_legend(picture, legend, dark)
    return picture if background is None else picture.convert("RGB")


def side_by_side(pictures: Sequence[Image.Image]) -> Image.Image:
    """Join pictures of equal height and mode in a row."""
    row = Image.new(
        pictures[0].mode, (sum(picture.width for picture in pictures), pictures[0].height)
    )
    left = 0
    for picture in pictures:
        row.paste(picture, (left, 0))
        left += picture.width
    return row


def png(picture: Image.Image, caption: Mapping[str, str]) -> bytes:
    """PNG file with the caption {name: value} as its text."""
    info = PngInfo()
    for name, value in {"Software": "Tofscope", **caption}.items():
        info.add_text(name, value)
    data = io.BytesIO()
    picture.save(data, "PNG", pnginfo=info)
    return data.getvalue()


def _draw_legend(picture: Image.Image, legend: Legend, dark: bool) -> None:
    size = max(9, round(_TEXT * picture.height))
    font, draw = ImageFont.load_default(size), ImageDraw.Draw(picture)
    line, left, dot = round(1.5 * size), size, round(0.7 * size)
    top = picture.height - size - line * (len(legend.entries) + (legend.ramp is not None))
    ink, ground = (_LIGHT_INK, _DARK_GROUND) if dark else (_DARK_INK, _LIGHT_GROUND)
    widths = [1.7 * dot + draw.textlength(entry.text, font) for entry in legend.entries]
    if legend.ramp is not None:
        widths.append(9 * size + draw.textlength(legend.ramp.low + legend.ramp.high, font))
    edge = left // 2
    # A shaded box keeps the text readable over points.
    shade = Image.new("RGBA", picture.size)
    ImageDraw.Draw(shade).rounded_rectangle(
        (edge, top - edge, left + max(widths, default=0) + edge, picture.height - edge),
        radius=edge,
        fill=ground,
    )
    picture.alpha_composite(shade)
    for entry in legend.entries:
        middle = top + line / 2
        box = (left, middle - dot / 2, left + dot, middle + dot / 2)
        draw.ellipse(box, fill=(*entry.colour, 255))
        draw.text((left + 1.7 * dot, middle), entry.text, fill=ink, font=font, anchor="lm")
        top += line
    if legend.ramp is not None:
        middle = top + line // 2
        draw.text((left, middle), legend.ramp.low, fill=ink, font=font, anchor="lm")
        start = left + round(draw.textlength(legend.ramp.low, font)) + size // 2
        width = 8 * size
        strip = blend(legend.ramp.colours, np.linspace(0.0, 1.0, width))
        bar = Image.fromarray(np.tile(strip[None], (dot, 1, 1)))
        picture.paste(bar, (start, middle - dot // 2))
        end = (start + width + size // 2, middle)
        draw.text(end, legend.ramp.high, fill=ink, font=font, anchor="lm")
