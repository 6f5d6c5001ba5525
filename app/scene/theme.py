"""Light and dark theme of the page."""

import viser

from app.scene.colours import BRAND, BRIGHT_BRAND, Colour


def apply_theme(gui: viser.GuiApi, dark: bool) -> None:
    """Apply the light or the dark theme to the page."""
    gui.configure_theme(
        dark_mode=dark,
        show_logo=False,
        show_share_button=False,
        brand_color=BRIGHT_BRAND if dark else BRAND,
    )


def background(dark: bool) -> Colour:
    """Background colour of the scene on a dark or a light page."""
    return (22, 24, 28) if dark else (246, 247, 250)
