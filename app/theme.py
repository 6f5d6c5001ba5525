"""How the page is dressed."""

import viser

from app.colours import BRAND


def dress(gui: viser.GuiApi, dark: bool) -> None:
    """Dress the page in light or dark."""
    gui.configure_theme(dark_mode=dark, show_logo=False, show_share_button=False, brand_color=BRAND)
