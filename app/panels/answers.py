"""Answers to the pointer: what is known of a point or zone under it, and of the pinned one."""

from dataclasses import dataclass
from typing import Any, Self

import viser
from pydantic import model_validator

from app.analysis.answers import Answer
from app.analysis.selection import cluster_of
from app.analysis.zones import Zone
from app.browser.assets import ChangedCalls, run_asset
from app.browser.page_events import EventContent, NoContent
from app.panels.answer_rows import rows, title
from app.panels.cluster_story import story
from app.panels.panel import Panel, PanelContext
from app.panels.triggers import post_on
from app.scene.palettes import Palette
from app.session.command import Background, LatestWins
from app.session.snapshot import Snapshot
from app.session.workbench import Workbench

Vector = tuple[float, float, float]

_FARTHEST = 1e6  # metres


class Ray(EventContent):
    """Ray through the pointer, in the drawing."""

    origin: Vector
    direction: Vector

    @model_validator(mode="after")
    def _check(self) -> Self:
        if max(map(abs, self.origin + self.direction)) > _FARTHEST or not any(self.direction):
            raise ValueError("this is no ray of a camera")
        return self


class ZonePlace(EventContent):
    """Zone in an image of the page."""

    sensor: int
    row: int
    column: int


class Pointed(EventContent):
    """What the pointer is on: a ray, a zone, or neither."""

    ray: Ray | None = None
    zone: ZonePlace | None = None


@dataclass(frozen=True)
class LookAt(Background, LatestWins):
    """Look at what the pointer is on."""

    pointed: Pointed

    def apply(self, workbench: Workbench) -> None:
        """Find it."""
        inspection, ray, place = workbench.inspection, self.pointed.ray, self.pointed.zone
        if ray is not None:
            inspection.point_along(ray.origin, ray.direction)
        else:
            side = inspection.inspected.images.side
            inspection.point(place and Zone(side, place.sensor, place.row, place.column))


@dataclass(frozen=True)
class LetGo(LatestWins):
    """Let go of the pinned zone, the selected sensor and the picked cluster."""

    def apply(self, workbench: Workbench) -> None:
        """Let go of them."""
        workbench.inspection.release()
        workbench.pick(None)


@dataclass(frozen=True)
class LookFromSensor(LatestWins):
    """Move the camera to the selected sensor."""

    def apply(self, workbench: Workbench) -> None:
        """Move it."""
        workbench.inspection.look_from_selected(workbench.framing)


class AnswersPanel(Panel):
    """Box beside the pointer, and a card in the corner of the scene for what is pinned."""

    def __init__(self, context: PanelContext) -> None:
        client, gui, post = context.client, context.client.gui, context.post
        self._calls = ChangedCalls(client, {"answers.point": None, "answers.pin": None})
        run_asset(client, "answers.css")
        run_asset(client, "answers.js")
        context.events.on("pointed", Pointed, lambda pointed: post(LookAt(pointed)))
        context.events.on("let_go", NoContent, lambda _: post(LetGo()))
        context.events.on("look_from_sensor", NoContent, lambda _: post(LookFromSensor()))
        let_go = gui.add_command("Let go of what is selected", hotkey="escape", icon=viser.Icon.X)
        post_on(post, LetGo(), let_go)
        view = gui.add_command("View: from the selected sensor", hotkey="5", icon=viser.Icon.CAMERA)
        post_on(post, LookFromSensor(), view)

    def show(self, snapshot: Snapshot) -> None:
        """Show what is known, where it has changed."""
        palette, inspected = snapshot.settings.palette, snapshot.inspected
        pointed, pinned = _content(inspected.pointed, palette), _content(inspected.pinned, palette)
        if pinned is not None:
            pinned["story"] = _story(snapshot)
        if pointed is None and inspected.pointed_sensor is not None:
            name = snapshot.opened.recording.sensors[inspected.pointed_sensor].name
            pointed = {"title": f"Sensor {name}", "rows": []}
        self._calls.send("answers.point", pointed)
        self._calls.send("answers.pin", pinned)


def _story(snapshot: Snapshot) -> str:
    """HTML of the picked cluster's story, "" without one."""
    if snapshot.pair is None or snapshot.pair.flow is None:
        return ""
    cluster = cluster_of(snapshot.pair, snapshot.picked)
    palette = snapshot.settings.palette
    return story(cluster, snapshot.parameters, palette) if cluster is not None else ""


def _content(answer: Answer | None, palette: Palette) -> dict[str, Any] | None:
    if answer is None:
        return None
    return {"title": title(answer), "rows": rows(answer, palette)}
