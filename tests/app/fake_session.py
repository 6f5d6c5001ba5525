"""What panels are made with, and what they are shown, without a session."""

from typing import Any

from app.analysis.estimates import Estimates
from app.analysis.library import Opened
from app.analysis.live_timeline import Outlook
from app.analysis.surveys import Surveys
from app.panels.panel import Desk, Shown
from app.scene.legend import Legend
from app.scene.settings import ViewSettings
from app.session.clock import Playback
from estimator import Parameters
from tests.app.fake_recordings import fake_opened


def desk(client: Any, post=lambda wish: None) -> Desk:
    return Desk(
        client, [fake_opened().entry], Parameters(), ViewSettings(), post, Surveys(Estimates())
    )


def shown(opened: Opened, frame: int = 20, parameters: Parameters | None = None) -> Shown:
    parameters = parameters or Parameters()
    return Shown(
        opened=opened,
        frame=frame,
        parameters=parameters,
        settings=ViewSettings(),
        legend=Legend(),
        pair=Estimates().estimated(opened, frame, parameters),
        comparison=None,
        other=None,
        picked=None,
        playing=False,
        playback=Playback(0, len(opened.recording) - 1),
        timeline=Outlook(Estimates(), Surveys(Estimates())).timeline(opened, parameters),
        seeking=False,
    )
