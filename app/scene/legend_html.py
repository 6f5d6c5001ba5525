"""The legend as HTML over the scene."""

from html import escape

from app.scene.colours import Colour, css
from app.scene.legend import Legend, Ramp


def html(legend: Legend) -> str:
    """HTML of a box in the lower left corner of the scene, "" for an empty legend."""
    if not legend.entries and legend.ramp is None:
        return ""
    ground, ink = ("#1c1d20cc", "#e6e7ea") if legend.dark else ("#ffffffd9", "#26282c")
    rows = "".join(_row(_dot(entry.colour), entry.text) for entry in legend.entries)
    if legend.ramp:
        rows += _ramp(legend.ramp)
    return (
        '<div style="position: fixed; left: calc(var(--scene-left, 0px) + 14px); '
        "bottom: calc(var(--scene-bottom, 0px) + var(--corner-height, 0px) + 14px); "
        "z-index: 1; pointer-events: none; "
        f"background: {ground}; color: {ink}; padding: 6px 10px; border-radius: 6px; "
        f'font-size: 12px; line-height: 18px" data-legend>{rows}</div>'
    )


def _row(sign: str, text: str) -> str:
    return f'<div style="display: flex; align-items: center">{sign}{escape(text)}</div>'


def _dot(colour: Colour) -> str:
    return (
        '<span style="width: 9px; height: 9px; border-radius: 50%; margin-right: 8px; flex: none; '
        f'background: {css(colour)}"></span>'
    )


def _ramp(ramp: Ramp) -> str:
    colours = ", ".join(css(colour) for colour in ramp.colours)
    return (
        '<div style="display: flex; align-items: center; gap: 6px">'
        f'{escape(ramp.low)}<span style="width: 90px; height: 9px; border-radius: 4px; '
        f'background: linear-gradient(to right, {colours})"></span>{escape(ramp.high)}</div>'
    )
