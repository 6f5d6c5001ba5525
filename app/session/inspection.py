"""What a person looks at: the zone under the pointer, the pinned one, the selected sensor."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from app.analysis.answers import Answer, answer
from app.analysis.library import Opened
from app.analysis.moving_targets import moving_targets
from app.analysis.pairs import Pair
from app.analysis.pointing import DrawnPoints, PointHit, Sight, point_at
from app.analysis.zones import (
    SOURCE,
    TARGET,
    Side,
    Zone,
    cloud_of,
    cluster_of_point,
    has_zone,
    zone_of_point,
)
from app.errors import InputError
from app.scene.framing import Framing
from app.scene.pointer_view import Mark, PointerView
from app.scene.scene import Scene
from app.scene.scene_root import upright
from app.scene.sensor_view import sensor_at, view_from
from app.scene.settings import HIDDEN, ViewSettings

BY_DISTANCE, BY_LABEL = "Distance", "Label"
IMAGE_COLOURS: tuple[str, ...] = (BY_DISTANCE, BY_LABEL)
"""What the colours of the sensors' images say."""

_POINTED = {False: (20, 20, 24), True: (250, 250, 250)}
"""{whether the page is dark: colour of the marks of the zone under the pointer}."""


@dataclass(frozen=True)
class ImageSettings:
    """Settings of the sensors' images.

    Attributes:
        side: the cloud whose images are shown.
        colours: what their colours say, one of `IMAGE_COLOURS`.
        seen: whether the page shows them now.
    """

    side: Side = TARGET
    colours: str = BY_DISTANCE
    seen: bool = False


@dataclass(frozen=True)
class Inspected:
    """What a person looks at.

    Attributes:
        selected: index of the selected sensor, None without one.
        pointed: of the zone under the pointer, None without one.
        pointed_sensor: index of the sensor whose frustum is under the pointer, None without one.
        pinned: of the pinned zone, None without one.
        images: settings of the sensors' images.
    """

    selected: int | None = None
    pointed: Answer | None = None
    pointed_sensor: int | None = None
    pinned: Answer | None = None
    images: ImageSettings = ImageSettings()


class Inspection:
    """Follows the zones and the sensor that a person looks at from frame to frame.

    Args:
        view: draws them.
        scene: whose drawing rays are given in.

    Attributes:
        inspected: as of the last `follow`.
    """

    def __init__(self, view: PointerView, scene: Scene) -> None:
        self._view, self._scene = view, scene
        self._pointed: Zone | None = None
        self._pinned: Zone | None = None
        self._awaited: tuple[int | None, Zone | None] = None, None
        self._opened: Opened | None = None
        self._pair: Pair | None = None
        self._settings = ViewSettings()
        self._done: tuple[object, ...] = ()
        self.inspected = Inspected()

    def change_images(self, values: Mapping[str, Any]) -> None:
        """Change some settings of the sensors' images, {name: value}."""
        images = replace(self.inspected.images, **values)
        self.inspected = replace(self.inspected, images=images)

    def point(self, zone: Zone | None) -> None:
        """Look at a zone, or at none, as long as the pointer is there."""
        self._point(zone if self._has(zone) else None, None)

    def point_along(self, origin: Sequence[float], direction: Sequence[float]) -> None:
        """Look at what is under a ray, given by (3,) and (3,) in the drawing."""
        found = self._under(origin, direction)
        if isinstance(found, PointHit):
            assert self._pair is not None
            self._point(zone_of_point(self._pair, found.side, found.index), None)
        else:
            self._point(None, found)

    def pin(self, zone: Zone) -> None:
        """Go on looking at a zone, and select its sensor."""
        if self._has(zone):
            self._pinned = zone
            self.select(zone.sensor)

    def pin_along(self, origin: Sequence[float], direction: Sequence[float]) -> int | None:
        """Pin the zone of the point under a ray, or select the sensor under it, or let go.

        Args:
            origin: (3,) of the ray in the drawing, metres.
            direction: (3,) of the ray in the drawing.

        Returns:
            Index of the point's cluster, None without one.
        """
        found = self._under(origin, direction)
        if not isinstance(found, PointHit):
            self.release()
            self.select(found)
            return None
        assert self._pair is not None
        self.pin(zone_of_point(self._pair, found.side, found.index))
        return cluster_of_point(self._pair, found.side, found.index)

    def select(self, sensor: int | None) -> None:
        """Select the sensor with this index, or none."""
        if sensor is None or (self._opened and 0 <= sensor < len(self._opened.recording.sensors)):
            self.inspected = replace(self.inspected, selected=sensor)

    @property
    def pinned(self) -> Zone | None:
        """The pinned zone, None without one."""
        return self._pinned

    def start_from(self, selected: int | None, pinned: Zone | None) -> None:
        """Select this sensor and pin this zone in the next recording, as far as it has them."""
        self._awaited = selected, pinned

    def release(self) -> None:
        """Let go of the pinned zone and of the selected sensor."""
        self._pinned = None
        self.select(None)

    def look_from_selected(self, framing: Framing) -> None:
        """Move the camera to the selected sensor.

        Raises:
            InputError: no sensor is selected, or its pose is unknown.
        """
        chosen = self.inspected.selected
        if self._opened is None or self._pair is None or chosen is None:
            raise InputError("Select a sensor first: click on its image, or on its frustum.")
        sensor, cloud = self._opened.recording.sensors[chosen], self._pair.target
        pose, ranges = cloud.T_fixed_sensor[chosen], cloud.ranges[chosen]
        if not np.isfinite(pose).all():
            raise InputError(f"The pose of the sensor {sensor.name} is not known at this frame.")
        measured = ranges[np.isfinite(ranges)]
        depth = float(np.median(measured)) if len(measured) else float("nan")
        R_drawing_fixed = upright(self._opened.recording.fixed_frame)
        view = view_from(sensor, pose, depth, R_drawing_fixed, self._view.aspect)
        framing.look(*view)

    def follow(
        self, opened: Opened, pair: Pair | None, max_range: float, settings: ViewSettings
    ) -> None:
        """Find and draw what a person looks at in the pair that is drawn.

        Args:
            opened: the open recording; another one than before lets go of everything.
            pair: that is drawn, None where none is.
            max_range: of its clouds, metres.
            settings: of the drawing.

        Raises:
            RecordingError: the file is broken at the truth.
        """
        if opened is not self._opened:
            self._opened = opened
            self._point(None, None)
            self.release()
            self._begin()
        self._view.adapt_size()
        wanted = (settings, self._pointed, self._pinned, self.inspected.selected)
        if pair is self._pair and wanted == self._done:
            return
        self._pair, self._settings, self._done = pair, settings, wanted
        if pair is None:
            self.inspected = replace(self.inspected, pointed=None, pinned=None)
        else:
            pointed, pinned = (
                answer(opened.recording, pair, zone, max_range) if zone else None
                for zone in (self._pointed, self._pinned)
            )
            self.inspected = replace(self.inspected, pointed=pointed, pinned=pinned)
            self._draw(opened, pair, max_range, settings)

    def _begin(self) -> None:
        (selected, pinned), self._awaited = self._awaited, (None, None)
        self.select(selected)
        if pinned is not None:
            self.pin(pinned)

    def _draw(self, opened: Opened, pair: Pair, max_range: float, settings: ViewSettings) -> None:
        inspected, palette = self.inspected, settings.palette
        drawn = ((inspected.pinned, palette.picked), (inspected.pointed, _POINTED[settings.dark]))
        marks: list[Mark] = []
        for each, colour in drawn:
            if each is None or each.origin is None or each.direction is None:
                continue
            start, direction = np.array(each.origin), np.array(each.direction)
            hit = each.point is not None
            end = np.array(each.point.position) if each.point else start + max_range * direction
            marks.append(Mark(start, end, hit, colour))
        self._view.mark(marks)
        chosen = inspected.selected
        sensor = None if chosen is None else opened.recording.sensors[chosen]
        pose = np.eye(4) if chosen is None else pair.target.T_fixed_sensor[chosen]
        self._view.select(sensor, pose, palette.picked)

    def _has(self, zone: Zone | None) -> bool:
        return (
            zone is not None and self._opened is not None and has_zone(self._opened.recording, zone)
        )

    def _point(self, zone: Zone | None, sensor: int | None) -> None:
        self._pointed = zone
        self.inspected = replace(self.inspected, pointed_sensor=sensor)

    def _under(self, origin: Sequence[float], direction: Sequence[float]) -> PointHit | int | None:
        """The point under a ray in the drawing, or the index of the sensor, or nothing.

        A frustum lies before most points: one that the pointer is only near to comes after it.
        """
        if self._pair is None or self._opened is None:
            return None
        start, along = (self._scene.in_fixed_frame(np.array(v)) for v in (origin, direction))
        sight = Sight.through(start, along, self._view.near, self._view.fov)
        point = point_at(self._pair, drawn_points(self._pair, self._settings), sight)
        if point is not None and point.angle <= sight.on:
            return point
        if not self._settings.layers & {"Sensors", "Frustums"}:
            return point
        sensors, poses = self._opened.recording.sensors, self._pair.target.T_fixed_sensor
        sensor = sensor_at(sensors, poses, sight.origin, sight.direction)
        return point if sensor is None else sensor


def drawn_points(pair: Pair, settings: ViewSettings) -> dict[Side, DrawnPoints]:
    """{cloud: its drawn points}, for the clouds that are drawn; what moves stands out."""
    drawn: dict[Side, DrawnPoints] = {}
    layers: tuple[tuple[Side, str], ...] = ((SOURCE, "Source"), (TARGET, "Target"))
    for side, layer in layers:
        cloud = cloud_of(pair, side)
        if cloud is None or layer not in settings.layers:
            continue
        clear = shown = np.ones(len(cloud.points), dtype=bool)
        if pair.flow is not None:
            clear = pair.flow.moving if side == SOURCE else moving_targets(pair)
        if settings.static_scene == HIDDEN:
            shown = clear
        drawn[side] = DrawnPoints(shown, clear)
    return drawn
