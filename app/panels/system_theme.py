"""Dark or light as the system of the person at the page is."""

from app.browser.assets import run_asset
from app.browser.opening_card import keep_theme
from app.browser.page_events import EventContent
from app.panels.panel import Panel, PanelContext
from app.session.commands import FollowSystem
from app.session.snapshot import Snapshot


class _System(EventContent):
    dark: bool


class SystemTheme(Panel):
    """Follows the system, and lets a reload begin as the page is; shows nothing."""

    def __init__(self, context: PanelContext) -> None:
        self._client, post = context.client, context.post
        self._told: tuple[bool, bool] | None = None
        run_asset(self._client, "system_theme.js")
        context.events.on("system", _System, lambda system: post(FollowSystem(system.dark)))

    def show(self, snapshot: Snapshot) -> None:
        """Tell the page how it is."""
        settings = snapshot.settings
        theme = settings.dark, not settings.follows_system
        if theme != self._told:
            self._told = theme
            keep_theme(self._client, *theme)
