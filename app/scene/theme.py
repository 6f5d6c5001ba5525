"""How the page is dressed."""

import viser

from app.scene.colours import BRAND, BRIGHT_BRAND, Colour


def dress(gui: viser.GuiApi, dark: bool) -> None:
    """Dress the page in light or dark."""
    gui.configure_theme(
        dark_mode=dark,
        show_logo=False,
        show_share_button=False,
        brand_color=BRIGHT_BRAND if dark else BRAND,
    )


def background(dark: bool) -> Colour:
    """What is behind the scene in a dark page or a light one."""
    return (20, 20, 20) if dark else (255, 255, 255)
