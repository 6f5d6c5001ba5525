"""The legend as HTML over the scene."""

from collections.abc import Sequence
from dataclasses import replace
from html import escape

from app.scene.colours import Colour, css
from app.scene.legend import Legend, LegendEntry, Ramp


def html(legend: Legend) -> str:
    """HTML of a box in the lower left corner of the scene, "" for an empty legend."""
    if not legend.entries and legend.ramp is None:
        return ""
    ground, ink = ("#1c1d20cc", "#e6e7ea") if legend.dark else ("#ffffffd9", "#26282c")
    rows = "".join(_row(title, entries) for title, entries in _grouped(legend.entries))
    if legend.ramp:
        rows += _ramp(legend.ramp)
    return (
        '<div style="position: fixed; left: calc(var(--scene-left, 0px) + 12px); '
        "bottom: calc(var(--scene-bottom, 0px) + var(--corner-height, 0px) + 14px); "
        "max-width: calc(var(--scene-width, 100vw) - 24px); box-sizing: border-box; "
        "z-index: 1; pointer-events: none; "
        f"background: {ground}; color: {ink}; padding: 6px 10px; border-radius: 6px; "
        f'font-size: 12px; line-height: 18px" data-legend>{rows}</div>'
    )


def _grouped(entries: Sequence[LegendEntry]) -> list[tuple[str, list[LegendEntry]]]:
    """Entries by what stands before their colon, "" for those without; in order."""
    groups: dict[str, list[LegendEntry]] = {}
    for entry in entries:
        title, colon, text = entry.text.rpartition(": ")
        groups.setdefault(title, []).append(replace(entry, text=text) if colon else entry)
    return list(groups.items())


def _row(title: str, entries: Sequence[LegendEntry]) -> str:
    name = f"<span>{escape(title)}</span>" if title else ""
    parts = "".join(
        f'<span style="display: flex; align-items: center">{_dot(entry.colour)}'
        f"{escape(entry.text)}</span>"
        for entry in entries
    )
    return f'<div style="display: flex; flex-wrap: wrap; column-gap: 12px">{name}{parts}</div>'


def _dot(colour: Colour) -> str:
    return (
        '<span style="width: 9px; height: 9px; border-radius: 50%; margin-right: 6px; flex: none; '
        f'background: {css(colour)}; box-shadow: 0 0 0 1px #8888"></span>'
    )


def _ramp(ramp: Ramp) -> str:
    colours = ", ".join(css(colour) for colour in ramp.colours)
    return (
        '<div style="display: flex; align-items: center; gap: 6px">'
        f'{escape(ramp.low)}<span style="width: 90px; height: 9px; border-radius: 4px; '
        f'background: linear-gradient(to right, {colours})"></span>{escape(ramp.high)}</div>'
    )
