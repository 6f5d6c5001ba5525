"""Timeline as a slim SVG strip below the frame slider."""

from app.analysis.timeline import Timeline
from app.scene.colours import css
from app.scene.palettes import Palette
from app.session.clock import Playback

_GAP = 4  # index of the categorical colour of gaps
_WIDTH = 1000  # of the SVG, stretched to the slider's width
_THIN = 3.0  # width of a gap's mark


def strip(timeline: Timeline, playback: Playback, palette: Palette, attributes: str) -> str:
    """HTML of a strip with motion, gaps, empty frames and the range of playback.

    Args:
        timeline: of the recording.
        playback: with the range.
        palette: of the drawing.
        attributes: HTML attributes of the strip, for clicks.
    """
    x = _Scale(timeline.count)
    flow, nothing, gap = css(palette.flow), css(palette.unassigned), css(palette.category(_GAP))
    # Gaps may be many: their marks are above those of motion, and thin.
    marks = [_bar(x(k - 0.5), x(k - 0.5), 0, 3, gap, thin=_THIN) for k in timeline.gaps]
    marks += [_bar(x(a), x(b), 4, 8, flow) for a, b in timeline.moving]
    marks += [_bar(x(a), x(b), 6, 4, nothing) for a, b in timeline.empty]
    base = _bar(0, _WIDTH, 7, 2, "currentColor", 0.25)
    shown = _bar(x(playback.first), x(playback.last), 7, 2, "currentColor", 0.6)
    legend = [("moving", flow, len(timeline.moving)), ("gap", gap, len(timeline.gaps))]
    legend.append(("empty", nothing, len(timeline.empty)))
    keys = "".join(_key(name, colour) for name, colour, number in legend if number)
    # Aligned with the track of viser's slider, between its label and its number.
    return (
        '<div style="display: flex; height: 1.5rem; margin-top: -0.4rem; padding: 0 4.4rem 0 1rem;'
        ' font-size: 0.65rem; line-height: 1.15">'
        f'<div style="width: 6.3rem; flex: none">{keys}</div>'
        f'<svg viewBox="0 0 {_WIDTH} 12" preserveAspectRatio="none" width="100%" height="12"'
        f' style="cursor: pointer" role="img" aria-label="timeline" {attributes}>'
        f"{base}{shown}{''.join(marks)}</svg></div>"
    )


class _Scale:
    def __init__(self, count: int) -> None:
        self._count = max(count - 1, 1)

    def __call__(self, frame: float) -> float:
        return _WIDTH * frame / self._count


def _bar(
    start: float,
    end: float,
    top: int,
    height: int,
    colour: str,
    opacity: float = 1.0,
    thin: float = 12.0,
) -> str:
    # A minimum width keeps single frames visible.
    start, width = (start - thin / 2, thin) if end - start < thin else (start, end - start)
    return (
        f'<rect x="{start:.1f}" y="{top}" width="{width:.1f}" height="{height}"'
        f' fill="{colour}" opacity="{opacity:g}"/>'
    )


def _key(name: str, colour: str) -> str:
    return (
        f'<span style="margin-right: 0.6em; white-space: nowrap">'
        f'<span style="display: inline-block;'
        f" width: 0.6em; height: 0.6em; margin-right: 0.3em; border-radius: 50%;"
        f' background: {colour}"></span>{name}</span>'
    )
