"""Controls of the view: camera, colours, sizes, layers."""

from dataclasses import dataclass
from typing import ClassVar, Literal

import numpy as np
import viser
from viser import Icon

from app.browser.assets import run_asset
from app.browser.controls import show_value
from app.browser.script import show_background
from app.panels.panel import Panel, PanelContext
from app.panels.triggers import post_chosen
from app.scene.camera import Camera
from app.scene.colours import css
from app.scene.lens import Lens, aspect_of
from app.scene.palettes import PALETTES
from app.scene.settings import ARROW_COLOURS, LAYERS, STATIC_SCENE
from app.scene.theme import apply_theme, background
from app.scene.views import ABOVE, FIT, FRONT, SENSORS, SLANTED
from app.session.command import Background, LatestWins, Repeated
from app.session.commands import ChangeView
from app.session.snapshot import Snapshot
from app.session.workbench import Workbench

_VISIBLE = 0.01  # relative change of the scale that is seen in the scale bar
_TURNED = np.cos(np.radians(5.0))  # of the angle by which a camera has turned
_KEYS: dict[str, Literal["1", "2", "3", "4", "F"]] = {
    SLANTED: "1",
    ABOVE: "2",
    FRONT: "3",
    SENSORS: "4",
    FIT: "F",
}
_SHORT = {"Slanted": SLANTED, "Above": ABOVE, "Front": FRONT, "Sensors": SENSORS, "Fit": FIT}
"""{label of its button: view}; the names themselves are too long for a row."""
_LAYER_HINTS = {
    "Robot": "Its links, as its description draws them.",
    "Sensors": "A mark where each sensor is.",
    "Frustums": "What each sensor can see.",
    "Source": "Points of the source, frame k-n.",
    "Target": "Points of the target, frame k.",
    "Flow": "An arrow from each moving point to where it went.",
    "Truth": "The true displacement of what moves, where it is known.",
    "True object": "Where what moves truly is: its mesh in simulated recordings, else its points "
    "moved by the truth.",
    "Grid and axes": "Grid of the floor, and the axes of the fixed frame.",
}
"""{layer: what it shows}."""


@dataclass(frozen=True)
class SetView(LatestWins):
    """Move the camera to the view of this name."""

    view: str

    def apply(self, workbench: Workbench) -> None:
        """Move the camera."""
        if workbench.pair is not None:
            workbench.framing.set_view(workbench.pair, self.view)


@dataclass(frozen=True)
class CameraMoved(Background, LatestWins):
    """The camera's distance, its direction or its aspect ratio has changed."""

    def apply(self, workbench: Workbench) -> None:
        """Adapt sizes and the view to the camera."""
        workbench.scene.adapt_sizes()
        if workbench.pair is not None:
            workbench.framing.adapt_to_window(workbench.pair)


class _Toggle(Repeated):
    setting: ClassVar[str]

    def apply(self, workbench: Workbench) -> None:
        """Toggle the setting, if posted an odd number of times."""
        if self.times % 2:
            before = getattr(workbench.settings, self.setting)
            workbench.change_view({self.setting: not before})


class ToggleDark(_Toggle):
    """Toggle the dark theme, as often as posted."""

    setting = "dark"


class ToggleLegend(_Toggle):
    """Toggle the legend, as often as posted."""

    setting = "legend"


class ViewPanel(Panel):
    """Controls of the drawing; none of them causes an estimate."""

    def __init__(self, context: PanelContext) -> None:
        self._client, self._gui, self._post = context.client, context.client.gui, context.post
        self._settings = context.settings
        self._dark = False  # pages start light
        run_asset(self._client, "scene.css")
        show_background(self._client, css(background(dark=False)))
        self._legend = self._settings.legend
        self._add_views(context.client.camera)
        self._add_colours()
        self._add_sizes()
        self._add_layers()

    def show(self, snapshot: Snapshot) -> None:
        """Apply the theme, and follow changes by commands."""
        if snapshot.settings.legend != self._legend:
            self._legend = snapshot.settings.legend
            show_value(self._legend_box, self._legend)
        if snapshot.settings.dark != self._dark:
            self._dark = snapshot.settings.dark
            show_value(self._dark_box, self._dark)
            apply_theme(self._gui, self._dark)
            show_background(self._client, css(background(self._dark)))

    def _add_views(self, camera: viser.CameraHandle) -> None:
        views = self._gui.add_button_group(
            "View from",
            tuple(_SHORT),
            hint=", ".join(f"{view} (key {key})" for view, key in _KEYS.items()),
        )

        @views.on_click
        async def _(_: viser.GuiEvent) -> None:
            post_chosen(self._post, views, _SHORT, SetView)

        for view, key in _KEYS.items():
            command = self._gui.add_command(f"View: {view}", hotkey=key, icon=Icon.CAMERA)
            command.on_trigger(lambda _, view=view: self._post(SetView(view)))

        drawn = [(Lens(0.0, 1.0), 0.0, np.zeros(3))]

        @camera.on_update
        async def _(camera: viser.CameraHandle) -> None:
            seen = Camera.of(camera.position, camera.look_at, camera.fov)
            lens, aspect, gaze = Lens.of(seen), aspect_of(camera), seen.direction
            before = drawn[0]
            same = lens.similar(before[0], _VISIBLE) and np.isclose(aspect, before[1], rtol=0.02)
            if not same or gaze @ before[2] < _TURNED:
                drawn[0] = (lens, aspect, gaze)
                self._post(CameraMoved())

    def _add_colours(self) -> None:
        colours = self._gui.add_dropdown(
            "Colours",
            PALETTES,
            initial_value=self._settings.colours,
            hint="Of points, arrows, plots and pictures.",
        )
        static = self._gui.add_dropdown(
            "Static scene",
            STATIC_SCENE,
            initial_value=self._settings.static_scene,
            hint="Points of both clouds that do not move.",
        )
        arrows = self._gui.add_dropdown(
            "Arrows show",
            ARROW_COLOURS,
            initial_value=self._settings.arrow_colours,
            hint="What the colour of an arrow says; the legend says which is which.",
        )
        dark = self._dark_box = self._gui.add_checkbox(
            "Dark", self._settings.dark, hint="Until it is chosen here, as the system is."
        )
        legend = self._legend_box = self._gui.add_checkbox(
            "Legend", self._settings.legend, hint="With the scale bar and the line below it."
        )
        toggle = self._gui.add_command("Dark or light", icon=Icon.MOON)
        toggle.on_trigger(lambda _: self._post(ToggleDark()))
        toggle_legend = self._gui.add_command("Legend", icon=Icon.LIST_DETAILS)
        toggle_legend.on_trigger(lambda _: self._post(ToggleLegend()))
        self._connect(colours, "colours", PALETTES)
        self._connect(static, "static_scene", STATIC_SCENE)
        self._connect(arrows, "arrow_colours", ARROW_COLOURS)
        self._connect(dark, "dark", (False, True))
        self._connect(legend, "legend", (False, True))

    def _add_sizes(self) -> None:
        arrow_scale = self._gui.add_slider(
            "Arrow scale",
            min=0.5,
            max=10.0,
            step=0.5,
            initial_value=self._settings.arrow_scale,
            marks=((0.5, "x 0.5"), (10.0, "x 10")),
            hint="Length of an arrow, as a multiple of the displacement over the pair: at 1 it "
            "ends where its point went.",
        )
        point_size = self._gui.add_slider(
            "Point size",
            min=1.0,
            max=20.0,
            step=0.5,
            initial_value=self._settings.point_size,
            marks=((1.0, "1"), (20.0, "20 px")),
            hint="Diameter of a point where the camera looks, wherever that is, in pixels of a "
            "picture that is 720 pixels high.",
        )

        # Coroutines run at once, before the control's value can change again.
        @arrow_scale.on_update
        async def _(_: viser.GuiEvent) -> None:
            self._post(ChangeView({"arrow_scale": min(max(arrow_scale.value, 0.5), 10.0)}))

        @point_size.on_update
        async def _(_: viser.GuiEvent) -> None:
            self._post(ChangeView({"point_size": min(max(point_size.value, 1.0), 20.0)}))

    def _add_layers(self) -> None:
        layers = {
            layer: self._gui.add_checkbox(
                layer, layer in self._settings.layers, hint=_LAYER_HINTS[layer]
            )
            for layer in LAYERS
        }

        async def post_layers(_: viser.GuiEvent) -> None:
            ticked = frozenset(layer for layer, box in layers.items() if box.value)
            self._post(ChangeView({"layers": ticked}))

        for box in layers.values():
            box.on_update(post_layers)

    def _connect(
        self,
        control: viser.GuiInputHandle,
        setting: str,
        choices: tuple[str, ...] | tuple[bool, ...],
    ) -> None:
        @control.on_update
        async def _(event: viser.GuiEvent) -> None:
            # A browser may send anything.
            if event.client_id is not None and control.value in choices:
                self._post(ChangeView({setting: control.value}))
