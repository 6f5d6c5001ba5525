"""Note in the scene: why nothing moves there, and what may be done about it."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from app.analysis.few_points import FEW_POINTS, for_few_points, has_too_few_points
from app.analysis.pairs import Pair
from app.browser.assets import ChangedCalls, run_asset
from app.browser.page_events import NoContent
from app.panels.panel import Panel, PanelContext
from app.panels.status import note_on
from app.panels.view import SetView
from app.scene.drawn_clouds import something_moves
from app.scene.views import FIT
from app.session.command import LatestWins
from app.session.snapshot import Snapshot
from app.session.workbench import Workbench
from estimator import PARAMETER_INFO

Action = tuple[str, str, str, dict[str, int]]
"""Text of a button, its hint, and kind and data of the event that it sends."""


@dataclass(frozen=True)
class TryFewPoints(LatestWins):
    """Set the parameters that suit few points, as one change."""

    def apply(self, workbench: Workbench) -> None:
        """Set them; undo takes them back."""
        workbench.tuning.set(for_few_points(workbench.tuning.parameters))


class SceneNotePanel(Panel):
    """Says above the legend why no arrow is drawn, or that what is drawn is out of the picture."""

    def __init__(self, context: PanelContext) -> None:
        self._calls = ChangedCalls(context.client)
        run_asset(context.client, "scene_note.css")
        run_asset(context.client, "scene_note.js")
        context.events.on("fit_view", NoContent, lambda _: context.post(SetView(FIT)))
        context.events.on("try_few_points", NoContent, lambda _: context.post(TryFewPoints()))

    def show(self, snapshot: Snapshot) -> None:
        """Show the note on the current pair, or none where something moves."""
        self._calls.send("note.show", _content(snapshot))


def _content(snapshot: Snapshot) -> dict[str, object]:
    pair, parameters = snapshot.pair, snapshot.parameters
    moves = pair is not None and something_moves(pair)
    if pair is not None and snapshot.out_of_picture and not snapshot.playing:
        what = "What moves is" if moves else "All points are"
        show: Action = ("Fit what moves" if moves else "Fit the points", "Key F", "fit_view", {})
        return {"text": f"{what} outside of the picture.", "actions": [show]}
    if pair is None or moves:
        return {"text": "", "actions": []}
    actions: list[Action] = []
    if has_too_few_points(pair, parameters):
        actions.append(("Try settings for few points", _FEW_HINT, "try_few_points", {}))
    if not snapshot.playing:
        actions += _to_motion(snapshot)
    return {"text": _why(snapshot, pair), "actions": actions}


def _why(snapshot: Snapshot, pair: Pair) -> str:
    """Why nothing moves in a pair, and whether none is found in the whole recording."""
    survey, why = snapshot.survey, note_on(pair, snapshot.parameters)
    if survey is None or not survey.complete or (survey.moving > 0).any():
        return why
    return f"{why} With these parameters no frame has any motion."


def _to_motion(snapshot: Snapshot) -> list[Action]:
    """Button that leads to the next frame at which something moves, or back to the last one."""
    frames = _moving_frames(snapshot)
    later, earlier = frames[frames > snapshot.frame], frames[frames < snapshot.frame]
    if len(later):
        return [_go("To the next motion", int(later[0]))]
    if len(earlier):
        return [_go("Back to the last motion", int(earlier[-1]))]
    return []


def _go(text: str, frame: int) -> Action:
    return text, f"Frame {frame}", "seek", {"frame": frame}


def _moving_frames(snapshot: Snapshot) -> NDArray[np.int64]:
    """Frames at which something moves, by the estimates.

    Until all frames are estimated, what is known of the recording counts.
    """
    survey = snapshot.survey
    if survey is not None and survey.complete:
        return np.flatnonzero(survey.moving > 0)
    return np.array([first for first, _ in snapshot.timeline.moving], dtype=np.int64)


def _entry(name: str, value: float | bool) -> str:
    info = PARAMETER_INFO[name]
    title = info.symbol or name.replace("_", " ")
    if isinstance(value, bool):
        return title
    return f"{title} {value:g}{f' {info.unit}' if info.unit and info.kind is float else ''}"


_FEW_HINT = (
    f"{', '.join(_entry(name, value) for name, value in FEW_POINTS.items())}: chosen on flights "
    "with one real sensor of 8 x 8 zones. Undo takes them back."
)
