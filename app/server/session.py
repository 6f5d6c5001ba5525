"""Session of one browser client, in its own thread."""

import logging
import threading
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace
from uuid import uuid4

import viser

from app.analysis.catalogue import Catalogue
from app.analysis.engine_switch import COMPILING, EngineSwitch
from app.analysis.estimates import Estimates
from app.analysis.library import Entry, Library
from app.analysis.live_timeline import LiveTimeline
from app.analysis.surveys import Surveys
from app.analysis.true_motions import TrueMotions
from app.browser.opening_card import show_nothing_open
from app.browser.page_events import PageEvents
from app.browser.script import keep_token, prefers_dark, take_link, take_token
from app.errors import InputError, UserError
from app.panels.page import Page, show_empty_page
from app.panels.panel import PanelContext
from app.scene.settings import ViewSettings
from app.session.choice import Choice
from app.session.command import Command
from app.session.commands import (
    FollowEngine,
    LookAgain,
    Move,
    OpenFirst,
    OpenRecording,
    ReceiveAbout,
    ReceiveSurveyUpdates,
    ReceiveTaskEvents,
    Restore,
)
from app.session.followed_sides import FollowedSides
from app.session.links import SavedSession, from_token
from app.session.queue import CommandQueue
from app.session.reload import Reloads
from app.session.tasks import Tasks
from app.session.tuning import Tuning
from app.session.workbench import Workbench
from estimator import Parameters

_LOG = logging.getLogger(__name__)
_NOT_DONE, _NOT_SHOWN = "That was not done", "Not everything can be shown"
"""Titles of errors."""
_PATIENCE = 60.0
"""Seconds that a page has to answer: a slow computer may be busy with loading it."""


@dataclass(frozen=True)
class Shared:
    """Thread-safe parts common to all sessions.

    Attributes:
        library: the recordings.
        estimates: cache of estimates.
        reloads: ended sessions, for reloads of their pages.
        parameters: initial ones of a session.
        engine: of the estimates.
        surveys: of whole recordings, computed in the background.
        motions: true motion of long recordings, read in the background.
        catalogue: of what is in the recordings, found out in the background.
    """

    library: Library
    estimates: Estimates
    reloads: Reloads
    parameters: Parameters
    engine: EngineSwitch = field(default_factory=EngineSwitch)
    surveys: Surveys = field(init=False)
    motions: TrueMotions = field(init=False)
    catalogue: Catalogue = field(init=False)

    def __post_init__(self) -> None:
        object.__setattr__(self, "surveys", Surveys(self.estimates))
        object.__setattr__(self, "motions", TrueMotions(self.estimates))
        catalogue = Catalogue(self.library, self.estimates.foreground)
        object.__setattr__(self, "catalogue", catalogue)


class Session:
    """Serves one client: viser's callbacks post commands, one thread applies them and draws.

    Args:
        client: the browser client.
        shared: parts common to all sessions.
    """

    def __init__(self, client: viser.ClientHandle, shared: Shared) -> None:
        self._client = client
        self._shared = shared
        self._queue = CommandQueue()
        self._last_error = ""
        self._thread = threading.Thread(target=self._run, name="session", daemon=True)
        self._thread.start()

    def close(self) -> None:
        """End the session; its thread then releases its resources."""
        self._queue.close()

    def join(self, timeout: float) -> None:
        """Wait for a closed session's thread, `timeout` seconds at most."""
        self._thread.join(timeout)

    def _run(self) -> None:
        try:
            entries = self._shared.library.listing()
            if not entries:
                show_empty_page(self._client, [str(path) for path in self._shared.library.paths])
                return
            token, saved = self._resume()
            labels = [entry.label for entry in entries]
            if saved and saved.label not in labels:
                self._report(
                    "Another recording is shown",
                    f"The recording {saved.label} is not among those that are listed here.",
                )
                saved = None  # its parameters were chosen for that recording
            # Before there is a page, so that the user's commands come after it.
            self._queue.post(OpenFirst((*([saved.label] if saved else []), *labels)))
            if saved:
                self._queue.post(Restore(saved))
            workbench, page = self._build(entries, saved)
            engine = self._shared.engine
            leave = engine.subscribe(lambda said: self._queue.post(FollowEngine(said)))
            if engine.compiling:
                self._queue.post(FollowEngine(COMPILING))
            try:
                self._serve(workbench, page)
                if ended := workbench.saved():
                    self._shared.reloads.keep(token, ended)
            finally:
                leave()
                workbench.close()
        except Exception:
            # A client that disconnects takes its page with it, also while that is being built.
            level = logging.WARNING if self._queue.closed else logging.ERROR
            _LOG.log(level, "A session has ended unexpectedly.", exc_info=True)
            if not self._queue.closed:
                said = "Something unexpected went wrong; reload this page."
                show_nothing_open(self._client, said)

    def _resume(self) -> tuple[str, SavedSession | None]:
        """Token of this session, and the session to resume from a link or a reload, if any."""
        token, saved = str(uuid4()), None
        try:
            if link := take_link(self._client, timeout=_PATIENCE):
                saved = from_token(link)
            else:
                saved = self._shared.reloads.take(take_token(self._client, timeout=_PATIENCE))
        except RuntimeError:
            pass  # a browser without storage starts a new session
        except TimeoutError:
            sentence = (
                "Its browser did not say in time what it showed before; reload it to try again."
            )
            self._report("The page begins anew", sentence)
        except InputError as error:
            self._report("The link cannot be followed", str(error))
        except Exception:
            # Whatever a browser keeps or sends must not keep anybody out.
            _LOG.exception("A link or a reload could not be followed.")
            sentence = "What this page showed before could not be found; it begins anew."
            self._report("The page begins anew", sentence)
        keep_token(self._client, token)
        return token, saved

    def _prefers_dark(self) -> bool:
        try:
            return prefers_dark(self._client, timeout=_PATIENCE)
        except (RuntimeError, TimeoutError):
            return False  # of a browser without storage

    def _build(
        self, entries: Sequence[Entry], saved: SavedSession | None
    ) -> tuple[Workbench, Page]:
        shared, post = self._shared, self._queue.post
        parameters = saved.parameters if saved else shared.parameters
        settings = saved.settings if saved else ViewSettings()
        if settings.follows_system:
            settings = replace(settings, dark=self._prefers_dark())
        workbench = Workbench(
            self._client,
            shared.library,
            shared.estimates,
            Choice(
                shared.library, shared.catalogue, entries, lambda found: post(ReceiveAbout(found))
            ),
            Tuning(parameters, shared.parameters),
            settings,
            FollowedSides(shared.surveys, lambda update: post(ReceiveSurveyUpdates((update,)))),
            LiveTimeline(
                shared.estimates, shared.surveys, shared.motions, lambda: post(LookAgain())
            ),
            Tasks(lambda event: post(ReceiveTaskEvents((event,)))),
        )
        events = PageEvents(self._client)
        context = PanelContext(self._client, parameters, settings, post, events)
        return workbench, Page(context)

    def _serve(self, workbench: Workbench, page: Page) -> None:
        def due() -> float | None:
            return workbench.clock.wait(workbench.frame, time.monotonic())

        while (commands := self._queue.take(due())) is not None:
            fine = [
                self._try(lambda command=command: self._apply(command, workbench, page), _NOT_DONE)
                for command in commands
            ]
            fine.append(self._try(lambda: page.announce(workbench.status()), _NOT_SHOWN))
            fine.append(self._try(lambda: self._draw(workbench, page), _NOT_SHOWN))
            if all(fine):
                self._last_error = ""

    def _apply(self, command: Command, workbench: Workbench, page: Page) -> None:
        command.apply(workbench)
        # Later commands in the queue refer to the recording that this one opens.
        while workbench.open_requests.label is not None:
            page.announce(workbench.status())
            workbench.open_next()

    def _draw(self, workbench: Workbench, page: Page) -> None:
        if self._queue.has(OpenRecording):
            return  # the current recording is about to be closed
        try:
            workbench.draw()
        finally:
            # Also if the frame cannot be drawn: the page then shows its number.
            snapshot = workbench.snapshot(seeking=self._queue.has(Move))
            if snapshot is not None:
                page.show(snapshot)

    def _try(self, action: Callable[[], None], failed: str) -> bool:
        """Run an action, report its error to the user, and return whether it succeeded.

        Args:
            action: to run.
            failed: title of its error.
        """
        try:
            action()
        except UserError as error:
            self._report(failed, str(error))
        except Exception as error:
            if self._queue.closed:
                return False  # a client that disconnects takes its page with it
            sentence = f"Something unexpected went wrong ({type(error).__name__}: {error})."
            if self._report(failed, sentence):
                _LOG.exception("An unexpected error.")
        else:
            return True
        return False

    def _report(self, title: str, sentence: str) -> bool:
        """Show an error to the user unless it repeats the last one; return whether it was shown."""
        # A recording broken at every frame must not show an error per frame.
        if sentence == self._last_error:
            return False
        self._last_error = sentence
        self._client.add_notification(title, sentence, color="red", auto_close_seconds=15)
        return True
