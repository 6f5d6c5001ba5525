"""Animated scene as one HTML file, which a browser plays without network."""

from collections.abc import Callable, Mapping, Sequence
from html import escape

import numpy as np

from app.analysis.comparison import Comparison
from app.analysis.estimates import Estimates
from app.analysis.library import Opened
from app.browser.guarded_server import GuardedServer
from app.browser.internals import NO_FLASH, PAGE_TITLE, PAUSE_TO_TYPE
from app.errors import InputError
from app.exports.captions import caption
from app.output.checks import GENERATOR
from app.output.text import escaped
from app.scene.camera import Camera
from app.scene.legend import Legend, LegendEntry
from app.scene.legend_html import html
from app.scene.scene import Scene
from app.scene.settings import ViewSettings
from app.scene.theme import apply_theme
from estimator import Parameters
from recordings import Recording

MOST_FRAMES = 3000
"""A page with more frames would be too large for a browser."""

# Clear of the player's bar at the bottom.
_LEGEND_STYLE = """<style>
[data-legend] { bottom: 54px !important; font-family: system-ui, sans-serif }
</style>"""


def offline_page(
    opened: Opened,
    frames: Sequence[int],
    parameters: Parameters,
    settings: ViewSettings,
    camera: str | Camera,
    estimates: Estimates,
    progress: Callable[[int], None],
    comparison: Comparison | None = None,
) -> str:
    """Render frames of a recording as an HTML page that plays them at their recorded speed.

    Args:
        opened: the recording.
        frames: k of each frame, increasing; at least one.
        parameters: of the estimate.
        settings: of the drawing.
        camera: initial camera, or one of `VIEWS`.
        estimates: computes and caches flows.
        progress: called with the number of frames drawn; an error it raises ends the work.
        comparison: with other parameters, whose flow is drawn too if its `both` is set.

    Raises:
        InputError: more frames than a page may have.
        RecordingError: the recording is broken at one of them.
    """
    if len(frames) > MOST_FRAMES:
        raise InputError(
            f"{len(frames)} frames are too many for one page, which holds {MOST_FRAMES} at most; "
            "take a part of them with tofscope export --frames FIRST:LAST --html FILE."
        )
    recording = opened.recording
    # viser records messages of a server only, not of a single client.
    server = GuardedServer("127.0.0.1", 0)
    try:
        apply_theme(server.gui, settings.dark)
        scene = Scene(server, settings)
        scene.open(recording)
        scene.change(settings)
        first = estimates.estimated_in_background(opened, frames[0], parameters)
        scene.show(first)
        if isinstance(camera, Camera):
            scene.set_camera(camera)
        else:
            scene.place_camera(estimates.pair(opened, frames[len(frames) // 2], parameters), camera)
        entries: dict[str, LegendEntry] = {}
        recorder = server.get_scene_serializer()
        for index, (k, pause) in enumerate(zip(frames, _pauses(recording, frames), strict=True)):
            progress(index)
            pair = estimates.estimated_in_background(opened, k, parameters)
            if comparison is not None and comparison.both:
                other = estimates.estimated_in_background(opened, k, comparison.other)
                scene.show(pair, other, comparison.edited)
            else:
                scene.show(pair)
            entries |= {entry.text: entry for entry in scene.legend.entries}
            recorder.insert_sleep(pause)
        legend = Legend(tuple(entries.values()), scene.legend.ramp, settings.dark)
        page = recorder.as_html(dark_mode=settings.dark)
    finally:
        server.stop()
    title = escaped(recording.name)
    title += " (simulated)" if recording.simulated else ""
    page = page.replace(PAGE_TITLE, f"{GENERATOR}<title>{escape(title)}</title>", 1)
    end = page.rindex("</body>")
    sides = comparison.drawn(parameters) if comparison else {}
    texts = dict(caption(recording, parameters, None, sides))
    texts["Frames"] = f"{frames[0]} to {frames[-1]} of {len(recording) - 1}"
    added = _LEGEND_STYLE + html(legend) + _about(title, texts, dark=settings.dark)
    added += NO_FLASH + PAUSE_TO_TYPE
    return page[:end] + added + page[end:]


def _pauses(recording: Recording, frames: Sequence[int]) -> list[float]:
    """Seconds to show each frame; the median interval for the last."""
    pauses = np.diff(recording.stamps[list(frames)])
    usual = float(np.median(pauses)) if len(pauses) else 0.0
    return [*map(float, pauses), usual]


def _about(title: str, texts: Mapping[str, str], *, dark: bool) -> str:
    """HTML of a folded box over the scene with the caption {name: value}."""
    ink, paper = ("#ddd", "rgba(30, 30, 34, 0.88)") if dark else ("#222", "#ffffffe0")
    rows = "".join(_row(name, value) for name, value in texts.items())
    box = (
        "position: fixed; top: 0.75rem; right: 0.75rem; z-index: 2; max-width: 30rem; "
        "padding: 0.5rem 0.75rem; border-radius: 0.4rem; "
        f"background: {paper}; color: {ink}; "
        "font: 0.8rem/1.5 system-ui, sans-serif; box-shadow: 0 0 0.8rem #0002"
    )
    return (
        f'<details id="about" style="{box}"><summary style="cursor: pointer">'
        f"<strong>{escape(title)}</strong></summary>"
        f'<table style="border-spacing: 0; margin-top: 0.4rem">{rows}</table>'
        '<div style="margin-top: 0.4rem">Made with Tofscope. Drag to turn, right button to move, '
        "wheel to zoom, space to pause.</div></details>"
    )


def _row(name: str, value: str) -> str:
    # Parameters are JSON; they read better without its punctuation.
    value = value.strip("{}").replace('"', "")
    return (
        '<tr style="vertical-align: top"><td style="padding-right: 1em; white-space: nowrap">'
        f'{escape(name)}</td><td style="overflow-wrap: anywhere">{escape(value)}</td></tr>'
    )
