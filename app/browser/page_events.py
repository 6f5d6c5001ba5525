"""Events of our own elements in the page, such as a drag along the timeline."""

import json
import logging
from collections.abc import Callable
from typing import TypeVar

import viser
from pydantic import BaseModel, ConfigDict, JsonValue, ValidationError

from app.browser.assets import run_asset
from app.browser.internals import element_id, run_script

_LOG = logging.getLogger(__name__)
_LONGEST = 10_000  # characters of an event

Content = TypeVar("Content", bound=BaseModel)


class EventContent(BaseModel):
    """Base of what an event holds: checked strictly, since a browser may send anything."""

    model_config = ConfigDict(strict=True, allow_inf_nan=False, extra="forbid", frozen=True)


class NoContent(EventContent):
    """Content of an event that says all by its kind."""


class _Event(EventContent):
    kind: str
    number: int
    data: JsonValue = None


class PageEvents:
    """Receives the events that scripts send by `tofscope.tell(kind, data)`.

    They travel in the value of a text field that is not shown. Events that are not understood are
    dropped.

    Args:
        client: owner of the page.
    """

    def __init__(self, client: viser.ClientHandle) -> None:
        self._receivers: dict[str, Callable[[JsonValue], None]] = {}
        field = client.gui.add_text("Events of the page", "", visible=False)
        run_asset(client, "shared.js")  # which all scripts that send events use
        run_asset(client, "events.js")
        run_script(client, f"window.tofscope.field = {element_id(field)!r};")

        # A coroutine runs at once, before the next event can take the field.
        @field.on_update
        async def _(_: viser.GuiEvent) -> None:
            self._receive(field.value)

    def on(self, kind: str, content: type[Content], receive: Callable[[Content], None]) -> None:
        """Call `receive` with the content of each event of a kind, in viser's event loop.

        Args:
            kind: of the event.
            content: what its data must be.
            receive: posts a command.
        """
        # As JSON, whose lists may be tuples and whose whole numbers may be floats.
        self._receivers[kind] = lambda data: receive(content.model_validate_json(json.dumps(data)))

    def _receive(self, text: object) -> None:
        if not isinstance(text, str) or len(text) > _LONGEST:
            return
        try:
            event = _Event.model_validate_json(text)
            if receiver := self._receivers.get(event.kind):
                receiver(event.data)
        except ValidationError as error:
            _LOG.debug("An event of the page was not understood: %s", error)
