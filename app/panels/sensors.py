"""Images of all sensors, coloured by distance or label; a click selects a sensor."""

from dataclasses import dataclass
from typing import Any

import viser

from app.analysis.answers import Answer
from app.analysis.library import Opened
from app.analysis.zones import SOURCE, TARGET, Side, Zone
from app.browser.assets import call, run_asset
from app.browser.page_events import EventContent
from app.panels.answers import LookFromSensor, ZonePlace
from app.panels.panel import Panel, PanelContext
from app.panels.sensor_images import Look, images, layout, scale_limit
from app.panels.triggers import post_chosen, post_on
from app.session.command import LatestOfEach, LatestWins
from app.session.inspection import IMAGE_COLOURS
from app.session.snapshot import Snapshot
from app.session.workbench import Workbench

_SIDES: dict[str, Side] = {"Target, frame k": TARGET, "Source, frame k − n": SOURCE}


class ImagesSeen(EventContent):
    """Whether the page shows the images."""

    seen: bool


class SensorPlace(EventContent):
    """Sensor in the page."""

    sensor: int


@dataclass(frozen=True)
class ChangeImages(LatestOfEach):
    """Change settings of the sensors' images, {name: value}."""

    def apply(self, workbench: Workbench) -> None:
        """Change them."""
        workbench.inspection.change_images(self.values)


@dataclass(frozen=True)
class SelectSensor(LatestWins):
    """Select the sensor with this index, or let go of it where it is selected."""

    sensor: int

    def apply(self, workbench: Workbench) -> None:
        """Select it."""
        selected = workbench.inspection.inspected.selected
        workbench.inspection.select(None if selected == self.sensor else self.sensor)


@dataclass(frozen=True)
class PinZone(LatestWins):
    """Pin a zone of the images, and select its sensor."""

    place: ZonePlace

    def apply(self, workbench: Workbench) -> None:
        """Pin it."""
        inspection, place = workbench.inspection, self.place
        side = inspection.inspected.images.side
        inspection.pin(Zone(side, place.sensor, place.row, place.column))


class SensorsPanel(Panel):
    """Grid of the sensors' images, and the selected one enlarged; the page's script draws them."""

    def __init__(self, context: PanelContext) -> None:
        self._client, gui, post = context.client, context.client.gui, context.post
        self._limit = 0.0
        self._shown: tuple[object, ...] = ()
        self._marks: dict[str, Any] = {}
        run_asset(self._client, "sensors.css")
        run_asset(self._client, "zone_image.js")
        run_asset(self._client, "sensors.js")
        side = gui.add_dropdown(
            "Images of",
            tuple(_SIDES),
            hint="The frame that is shown, or the one that the flow starts from, n frames before; "
            "labels belong to its points.",
        )
        colours = gui.add_dropdown(
            "Colour", IMAGE_COLOURS, hint="Distance along the optical axis, or the labels' colours."
        )
        # The script fills it; React renders it anew where its content changes.
        gui.add_html('<div id="tofscope-sensors"></div>')
        view = gui.add_button(
            "From this sensor",
            icon=viser.Icon.CAMERA,
            color="gray",
            hint="Move the camera to the selected sensor, up as in its image. Key: 5",
        )
        post_on(post, LookFromSensor(), view)

        @side.on_update
        async def _(_: viser.GuiEvent) -> None:
            post_chosen(post, side, _SIDES, lambda side: ChangeImages({"side": side}))

        @colours.on_update
        async def _(_: viser.GuiEvent) -> None:
            names = {name: name for name in IMAGE_COLOURS}
            post_chosen(post, colours, names, lambda name: ChangeImages({"colours": name}))

        events = context.events
        events.on("images_seen", ImagesSeen, lambda e: post(ChangeImages({"seen": e.seen})))
        events.on("sensor_clicked", SensorPlace, lambda e: post(SelectSensor(e.sensor)))
        events.on("zone_clicked", ZonePlace, lambda e: post(PinZone(e)))

    def open(self, opened: Opened) -> None:
        """Lay out the sensors."""
        self._limit, self._shown, self._marks = 0.0, (), {}
        call(self._client, "sensors.open", layout(opened.recording))

    def show(self, snapshot: Snapshot) -> None:
        """Show the images of the frame while the page has them in view."""
        inspected, pair = snapshot.inspected, snapshot.pair
        if pair is None or not inspected.images.seen:
            self._shown = ()
            return
        recording = snapshot.opened.recording
        # A single sensor is always enlarged.
        enlarged = 0 if len(recording.sensors) == 1 else inspected.selected
        shown = (inspected.images, enlarged, snapshot.settings.palette)
        if not self._shown or self._shown[0] is not pair or self._shown[1:] != shown:
            self._shown = (pair, *shown)
            self._limit = scale_limit(pair.target, self._limit)
            settings = snapshot.settings
            look = Look(inspected.images, settings.palette, settings.dark, self._limit)
            max_range = snapshot.parameters.max_range
            found = images(recording, pair, max_range, enlarged, look)
            if found is None:
                call(self._client, "sensors.say", "There is no frame k − n this early.")
            else:
                call(self._client, "sensors.show", found)
        marks = {
            "selected": inspected.selected,
            "pointed": _place(inspected.pointed, inspected.images.side),
            "pinned": _place(inspected.pinned, inspected.images.side),
        }
        if marks != self._marks:
            self._marks = marks
            call(self._client, "sensors.mark", marks)


def _place(answer: Answer | None, side: Side) -> list[int] | None:
    """Sensor, row and column of a zone in the images of a cloud, None where it is of the other."""
    if answer is None or answer.zone.side != side:
        return None
    return [answer.zone.sensor, answer.zone.row, answer.zone.column]
