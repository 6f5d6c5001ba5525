"""A session: serves one browser client, in a thread of its own."""

import logging
import threading
from collections.abc import Callable
from dataclasses import dataclass, field
from uuid import uuid4

import viser

from app.analysis.estimates import Estimates
from app.analysis.library import Library
from app.analysis.surveys import Surveys
from app.browser.script import keep_token, take_link, take_token
from app.errors import InputError, UserError
from app.panels.page import show_empty_page
from app.scene.settings import ViewSettings
from app.session.commands import Arrive, OpenAny
from app.session.links import Place, from_token
from app.session.queue import Mailbox
from app.session.reload import Reloads
from app.session.workbench import Workbench
from estimator import Parameters

_LOG = logging.getLogger(__name__)


@dataclass(frozen=True)
class Shared:
    """What all sessions use together; every part is safe under many threads.

    Attributes:
        library: the recordings.
        estimates: what was computed already.
        reloads: what ended sessions left.
        parameters: with which a session begins.
        surveys: of whole recordings, in the background.
    """

    library: Library
    estimates: Estimates
    reloads: Reloads
    parameters: Parameters
    surveys: Surveys = field(init=False)

    def __post_init__(self) -> None:
        object.__setattr__(self, "surveys", Surveys(self.estimates))


class Session:
    """Serves one client: viser's callbacks post wishes, one thread fulfils them and draws.

    Args:
        client: the browser client.
        shared: what sessions share.
    """

    def __init__(self, client: viser.ClientHandle, shared: Shared) -> None:
        self._client = client
        self._shared = shared
        self._mailbox = Mailbox()
        self._said = ""
        self._thread = threading.Thread(target=self._run, name="session", daemon=True)
        self._thread.start()

    def close(self) -> None:
        """End the session; its thread gives back what it holds."""
        self._mailbox.close()

    def join(self, timeout: float) -> None:
        """Wait for a closed session's thread, `timeout` seconds at most."""
        self._thread.join(timeout)

    def _run(self) -> None:
        try:
            entries = self._shared.library.listing()
            if not entries:
                show_empty_page(self._client, [str(path) for path in self._shared.library.paths])
                return
            token, place = self._arrive()
            labels = [entry.label for entry in entries]
            if place and place.label not in labels:
                self._say(f"The recording {place.label} is not among those that are listed here.")
                place = None  # nor do its parameters suit another one
            workbench = Workbench(
                self._client,
                self._shared.library,
                self._shared.estimates,
                self._shared.surveys,
                entries,
                place.parameters if place else self._shared.parameters,
                self._shared.parameters,
                place.settings if place else ViewSettings(),
                self._mailbox,
            )
            self._mailbox.post(OpenAny((*([place.label] if place else []), *labels)))
            if place:
                self._mailbox.post(Arrive(place))
            try:
                self._serve(workbench)
                if leaving := workbench.place():
                    self._shared.reloads.leave(token, leaving)
            finally:
                workbench.close()
        except Exception:
            # A client that leaves while its page is being built takes everything with it.
            _LOG.warning("A session could not begin.", exc_info=True)

    def _arrive(self) -> tuple[str, Place | None]:
        """A token for this session, and the place to begin at: a link's, or where it was left."""
        token, place = str(uuid4()), None
        try:
            if link := take_link(self._client, timeout=2.0):
                place = from_token(link)
            else:
                place = self._shared.reloads.take(take_token(self._client, timeout=2.0))
        except (RuntimeError, TimeoutError):
            pass  # a browser that stores nothing begins anew
        except InputError as error:
            self._say(str(error))
        keep_token(self._client, token)
        return token, place

    def _serve(self, workbench: Workbench) -> None:
        while (wishes := self._mailbox.take(workbench.wait())) is not None:
            fine = [self._try(lambda wish=wish: wish.fulfil(workbench)) for wish in wishes]
            fine.append(self._try(workbench.draw))
            if all(fine):
                self._said = ""

    def _try(self, action: Callable[[], None]) -> bool:
        """Do something; what goes wrong is told to the person, and the session goes on."""
        try:
            action()
        except UserError as error:
            self._say(str(error))
        except Exception as error:
            _LOG.debug("An unexpected error.", exc_info=True)
            self._say(f"Something unexpected went wrong ({type(error).__name__}: {error}).")
        else:
            return True
        return False

    def _say(self, sentence: str) -> None:
        # A recording that is broken at every frame complains once, not at every frame.
        if sentence != self._said:
            self._said = sentence
            self._client.add_notification("Tofscope", sentence, color="red", auto_close_seconds=15)
