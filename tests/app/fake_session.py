"""Surroundings and snapshots for panels, without a session."""

from typing import Any

from app.analysis.estimates import Estimates
from app.analysis.live_timeline import LiveTimeline
from app.analysis.surveys import Surveys
from app.analysis.true_motions import TrueMotions
from app.browser.page_events import PageEvents
from app.panels.panel import PanelContext
from app.scene.legend import Legend
from app.scene.settings import ViewSettings
from app.session.choice import Listing
from app.session.clock import Playback
from app.session.inspection import Inspected
from app.session.snapshot import Snapshot, Status
from estimator import Parameters
from tests.app.fake_recordings import fake_opened


def context(client: Any, post=lambda command: None) -> PanelContext:
    events = PageEvents(client)
    return PanelContext(client, Parameters(), ViewSettings(), post, events)


def status(**changes: Any) -> Status:
    """Status of a session that has nothing open, but for what is named."""
    fields: dict[str, Any] = {
        "opening": None,
        "opened": None,
        "listing": Listing((fake_opened().entry,)),
        "parameters": Parameters(),
        "parameters_revision": 0,
        "corrections": {},
        "corrected": 0,
        "preset_use": None,
        "tasks": (),
        "outbox": (),
    }
    return Status(**(fields | changes))


def snapshot(**changes: Any) -> Snapshot:
    """Snapshot of a session that shows a fake recording, but for what is named.

    The pair, the range of playback and the timeline follow from the rest.
    """
    opened = changes.get("opened") or fake_opened()
    frame, parameters = changes.get("frame", 20), changes.get("parameters") or Parameters()
    fields: dict[str, Any] = {
        **vars(status()),
        "opened": opened,
        "frame": frame,
        "parameters": parameters,
        "comparison": None,
        "settings": ViewSettings(),
        "legend": Legend(),
        "scale_bar": None,
        "other": None,
        "picked": None,
        "playing": False,
        "playback": Playback(0, len(opened.recording) - 1),
        "marks": (),
        "edited_mark": 0,
        "seeking": False,
        "plotted_pair": None,
        "survey": None,
        "survey_revision": 0,
        "other_survey": None,
        "other_survey_revision": 0,
        "inspected": Inspected(),
    }
    if "pair" not in changes:
        fields["pair"] = Estimates().estimated(opened, frame, parameters)
    if "timeline" not in changes:
        estimates = Estimates()
        motions = TrueMotions(estimates)
        live = LiveTimeline(estimates, Surveys(estimates), motions, lambda: None)
        fields["timeline"] = live.of(opened, parameters)
    return Snapshot(**(fields | changes))
