"""Surroundings and snapshots for panels, without a session."""

from typing import Any

from app.analysis.estimates import Estimates
from app.analysis.live_timeline import LiveTimeline
from app.analysis.surveys import Surveys
from app.panels.panel import PanelContext
from app.scene.legend import Legend
from app.scene.settings import ViewSettings
from app.session.clock import Playback
from app.session.snapshot import Snapshot, Status
from estimator import Parameters
from tests.app.fake_recordings import fake_opened


def context(client: Any, post=lambda command: None) -> PanelContext:
    return PanelContext(client, [fake_opened().entry], Parameters(), ViewSettings(), post)


def status(**changes: Any) -> Status:
    """Status of a session that has nothing open, but for what is named."""
    fields: dict[str, Any] = {
        "opening": None,
        "opened": None,
        "parameters": Parameters(),
        "parameters_revision": 0,
        "refusals": {},
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
        "other": None,
        "picked": None,
        "picked_in_scene": 0,
        "playing": False,
        "playback": Playback(0, len(opened.recording) - 1),
        "seeking": False,
        "time_seek": None,
        "survey": None,
        "survey_revision": 0,
    }
    if "pair" not in changes:
        fields["pair"] = Estimates().estimated(opened, frame, parameters)
    if "timeline" not in changes:
        estimates = Estimates()
        fields["timeline"] = LiveTimeline(estimates, Surveys(estimates)).of(opened, parameters)
    return Snapshot(**(fields | changes))
