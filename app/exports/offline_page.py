"""Animated scene as one HTML file, which a browser plays without network."""

import json
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from html import escape

import numpy as np

from app.browser.assets import text_of
from app.browser.guarded_server import GuardedServer
from app.browser.internals import NO_FLASH, PAGE_TITLE, PAUSE_TO_TYPE
from app.errors import InputError
from app.exports.captions import caption
from app.exports.drawn_pair import DrawnPair, DrawnPairs
from app.exports.figure_settings import corner_parts_of
from app.output.checks import GENERATOR
from app.output.text import escaped
from app.scene.camera import Camera
from app.scene.colours import css
from app.scene.legend import Legend
from app.scene.legend_html import html
from app.scene.scene import Scene
from app.scene.settings import ViewSettings
from app.scene.theme import apply_theme
from recordings import Recording

MOST_FRAMES = 3000
"""A page with more frames would be too large for a browser."""


def offline_page(
    pairs: DrawnPairs,
    frames: Sequence[int],
    begin: int,
    settings: ViewSettings,
    camera: str | Camera,
    progress: Callable[[int], None],
) -> str:
    """Render frames of a recording as an HTML page that plays them at their recorded speed.

    Args:
        pairs: of the recording, as they are drawn.
        frames: k of each frame, increasing; at least one.
        begin: k of the frame that it shows at first, standing still.
        settings: of the drawing.
        camera: initial camera, or one of `VIEWS`.
        progress: called with the number of frames drawn; an error it raises ends the work.

    Raises:
        InputError: more frames than a page may have.
        RecordingError: the recording is broken at one of them.
    """
    if len(frames) > MOST_FRAMES:
        raise InputError(
            f"{len(frames)} frames are too many for one page, which holds {MOST_FRAMES} at most; "
            "take a part of them with tofscope export --frames FIRST:LAST --html FILE."
        )
    recording = pairs.opened.recording
    said = _Said(recording)
    # viser records messages of a server only, not of a single client.
    server = GuardedServer("127.0.0.1", 0)
    try:
        apply_theme(server.gui, settings.dark)
        scene = Scene(server, settings)
        scene.open(recording)
        scene.change(settings)
        _show(scene, pairs.at(frames[0]))
        if isinstance(camera, Camera):
            scene.set_camera(camera)
        else:
            scene.place_camera(pairs.at(begin).pair, camera)
        recorder = server.get_scene_serializer()
        for index, (k, pause) in enumerate(zip(frames, _pauses(recording, frames), strict=True)):
            progress(index)
            drawn = pairs.at(k)
            _show(scene, drawn)
            said.add(drawn, scene.legend, pause)
            recorder.insert_sleep(pause)
        page = recorder.as_html(dark_mode=settings.dark)
    finally:
        server.stop()
    title = escaped(recording.name)
    title += " (simulated)" if recording.simulated else ""
    page = page.replace(PAGE_TITLE, f"{GENERATOR}<title>{escape(title)}</title>", 1)
    sides = pairs.comparison.drawn(pairs.parameters) if pairs.comparison else {}
    texts = dict(caption(recording, pairs.parameters, None, sides))
    texts["Frames"] = f"{frames[0]} to {frames[-1]} of {len(recording) - 1}"
    player = _player(said.content(list(frames).index(begin), settings), settings)
    added = _about(title, texts, dark=settings.dark) + player + NO_FLASH + PAUSE_TO_TYPE
    end = page.rindex("</body>")
    return page[:end] + added + page[end:]


@dataclass
class _Said:
    """What the page says of each of its frames."""

    recording: Recording
    frames: list[dict[str, object]] = field(default_factory=list)
    moving: list[int] = field(default_factory=list)
    legends: dict[str, int] = field(default_factory=dict)
    lasting: float = 0.0

    def add(self, drawn: DrawnPair, legend: Legend, pause: float) -> None:
        """Add the next frame, with its legend and the seconds until the next."""
        stamps, flow, k = self.recording.stamps, drawn.pair.flow, drawn.pair.frame
        self.moving.append(0 if flow is None else int(flow.moving.sum()))
        self.frames.append(
            {
                "numbers": k,
                "starts": round(self.lasting, 4),
                "seconds": round(float(stamps[k] - stamps[0]), 4),
                "lines": corner_parts_of(self.recording, drawn),
                "legend": self.legends.setdefault(html(legend), len(self.legends)),
            }
        )
        self.lasting += pause

    def content(self, begin: int, settings: ViewSettings) -> dict[str, object]:
        """Content of the page's script, which begins with the frame of this index."""
        most = max(*self.moving, 1)
        return {
            "begin": begin,
            "last": len(self.recording) - 1,
            "lasting": round(self.lasting, 4),
            "dark": settings.dark,
            "colour": css(settings.palette.flow),
            "legends": list(self.legends),
            "moving": [round(count / most, 2) for count in self.moving],
            **{name: [frame[name] for frame in self.frames] for name in self.frames[0]},
        }


def _show(scene: Scene, drawn: DrawnPair) -> None:
    scene.show(drawn.pair, drawn.second, drawn.side, drawn.picked)


def _pauses(recording: Recording, frames: Sequence[int]) -> list[float]:
    """Seconds to show each frame; the median interval for the last."""
    pauses = np.diff(recording.stamps[list(frames)])
    usual = float(np.median(pauses)) if len(pauses) else 0.0
    return [*map(float, pauses), usual]


def _player(content: Mapping[str, object], settings: ViewSettings) -> str:
    """HTML of legend, corner line, and what viser's player lacks."""
    styles = (text_of(name) for name in ("scene.css", "corner_line.css", "offline_player.css"))
    scripts = (text_of(name) for name in ("shared.js", "corner_line.js", "offline_player.js"))
    # A text in it must not end the script.
    said = json.dumps(content, separators=(",", ":")).replace("<", "\\u003c")
    return "".join(
        [
            f"<style>:root {{ --scene-background: {css(settings.background)} }}</style>",
            *(f"<style>{style}</style>" for style in styles),
            '<div id="tofscope-legend" style="font-family: system-ui, sans-serif"></div>',
            f'<script type="application/json" id="tofscope-frames">{said}</script>',
            *(f"<script>{script}</script>" for script in scripts),
        ]
    )


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
        '<div style="margin-top: 0.4rem">Made with Tofscope. Space plays and pauses, the arrow '
        "keys step, Home and End go to the ends. Drag to turn, right button to move, wheel to zoom."
        "</div></details>"
    )


def _row(name: str, value: str) -> str:
    # Parameters are JSON; they read better without its punctuation.
    value = value.strip("{}").replace('"', "")
    return (
        '<tr style="vertical-align: top"><td style="padding-right: 1em; white-space: nowrap">'
        f'{escape(name)}</td><td style="overflow-wrap: anywhere">{escape(value)}</td></tr>'
    )
