"""How things are drawn: arrow scale, point size, layers."""

import viser

from app.panel import Desk, Panel
from app.scene.settings import LAYERS
from app.wishes import ChangeView


class ViewPanel(Panel):
    """Change what is drawn; nothing of it makes the estimator run."""

    def __init__(self, desk: Desk) -> None:
        gui, settings, post = desk.client.gui, desk.settings, desk.post
        with gui.add_folder("View", expand_by_default=False):
            arrow_scale = gui.add_slider(
                "Arrow scale",
                min=0.05,
                max=2.0,
                step=0.05,
                initial_value=settings.arrow_scale,
                marks=((0.05, "0.05"), (2.0, "2 s")),
                hint="An arrow is as long as the way that is gone in this time [s].",
            )
            point_size = gui.add_slider(
                "Point size",
                min=0.5,
                max=15.0,
                step=0.5,
                initial_value=1e3 * settings.point_size,
                marks=((0.5, "0.5"), (15.0, "15 mm")),
                hint="Radius of a point [mm].",
            )
            layers = {layer: gui.add_checkbox(layer, layer in settings.layers) for layer in LAYERS}

        # Coroutines run at once, before anything can change a control's value again.
        @arrow_scale.on_update
        async def _(_: viser.GuiEvent) -> None:
            post(ChangeView({"arrow_scale": min(max(arrow_scale.value, 0.05), 2.0)}))

        @point_size.on_update
        async def _(_: viser.GuiEvent) -> None:
            post(ChangeView({"point_size": 1e-3 * min(max(point_size.value, 0.5), 15.0)}))

        async def post_layers(_: viser.GuiEvent) -> None:
            shown = frozenset(layer for layer, box in layers.items() if box.value)
            post(ChangeView({"layers": shown}))

        for box in layers.values():
            box.on_update(post_layers)
