"""Saved sessions, for reloads of the page and for links."""

import base64
import json
import math
from dataclasses import dataclass, field
from typing import Annotated, Any

from pydantic import BaseModel, ConfigDict, Field, JsonValue

from app.analysis.comparison import A, B, Comparison
from app.analysis.parameter_files import from_text
from app.analysis.quantities import QUANTITIES
from app.analysis.zones import Side, Zone
from app.errors import InputError
from app.scene.camera import Camera
from app.scene.framing import Vector
from app.scene.settings import ViewSettings
from app.session.clock import Playback
from app.session.linked_view import LinkedView, one_of
from estimator import Parameters, to_nested

_LONGEST = 6000  # characters of a link's token
_FARTHEST = 1e5  # metres
_FRAMES = 10**9  # more than any recording has
_CLUSTERS = 10**6  # more than any pair has; and more than there are sensors, rows, columns
_UP: Vector = (0.0, 0.0, 1.0)
_DAMAGED = "The link is damaged; copy it once more."


@dataclass(frozen=True)
class SavedSession:
    """Recording, frame and settings of a session.

    Attributes:
        label: of the recording in the list.
        frame: k.
        parameters: of the estimate.
        camera: of the scene, None for the default view.
        settings: of the drawing.
        comparison: with a second set of parameters, None without one.
        playback: of the recording, None for the defaults.
        playing: whether playback is running.
        picked: index of the picked cluster, None without one.
        plotted_pair: quantities (x, y) plotted against each other, None for none.
        selected: index of the selected sensor, None without one.
        pinned: the pinned zone, None without one.
        up: (3,) what points up in the camera's picture, in the drawing; None for the z axis.
    """

    label: str
    frame: int
    parameters: Parameters
    camera: Camera | None = None
    settings: ViewSettings = field(default_factory=ViewSettings)
    comparison: Comparison | None = None
    playback: Playback | None = None
    playing: bool = False
    picked: int | None = None
    plotted_pair: tuple[str, str] | None = None
    selected: int | None = None
    pinned: Zone | None = None
    up: Vector | None = None

    def token(self) -> str:
        """Encode all of it as a URL-safe token, but for what is personal to the sender.

        That is the playback, and whether the page is dark. Defaults are left out.
        """
        content: dict[str, Any] = {"recording": self.label, "frame": self.frame}
        content["parameters"] = _differences(self.parameters)
        if self.camera:
            numbers = (*self.camera.position, *self.camera.look_at, self.camera.fov)
            content["camera"] = [round(number, 4) for number in numbers]
        if self.comparison:
            content["comparison"] = {
                "other": _differences(self.comparison.other),
                "edited": self.comparison.edited,
                "both": self.comparison.both,
            }
        if view := LinkedView.of(self.settings).model_dump(exclude_defaults=True):
            content["view"] = view
        if self.picked is not None:
            content["picked"] = self.picked
        if self.plotted_pair is not None:
            content["plotted"] = self.plotted_pair
        if self.selected is not None:
            content["sensor"] = self.selected
        if (zone := self.pinned) is not None:
            content["zone"] = zone.side, zone.sensor, zone.row, zone.column
        if self.camera and self.up and self.up != _UP:
            content["up"] = [round(number, 4) for number in self.up]
        text = json.dumps(content, separators=(",", ":"))
        return base64.urlsafe_b64encode(text.encode()).decode().rstrip("=")


def from_token(token: str) -> SavedSession:
    """Decode the token of a link, which may contain anything.

    Raises:
        InputError: the token is invalid, or its parameters are.
    """
    if len(token) > _LONGEST:
        raise InputError(_DAMAGED)
    try:
        text = base64.b64decode(token + "=" * (-len(token) % 4), altchars=b"-_", validate=True)
        link = _Link.model_validate_json(text)
        camera = link.camera and _camera(link.camera)
        up = link.up and _direction(link.up)
    except ValueError as error:  # includes those of base64 and pydantic
        raise InputError(_DAMAGED) from error
    comparison = link.comparison and Comparison(
        _parameters(link.comparison.other), link.comparison.edited, link.comparison.both
    )
    return SavedSession(
        link.recording,
        link.frame,
        _parameters(link.parameters),
        camera,
        link.view.settings(),
        comparison,
        picked=link.picked,
        plotted_pair=link.plotted,
        selected=link.sensor,
        pinned=link.zone and Zone(*link.zone),
        up=up,
    )


_Metres = Annotated[float, Field(gt=-_FARTHEST, lt=_FARTHEST)]
_Radians = Annotated[float, Field(gt=0.01, lt=3.0)]


_Index = Annotated[int, Field(ge=0, lt=_CLUSTERS)]
_Quantity = Annotated[str, one_of(QUANTITIES)]


class _Content(BaseModel):
    """Base of what a token holds, validated strictly."""

    model_config = ConfigDict(strict=True, allow_inf_nan=False)


class _Comparison(_Content):
    other: dict[str, JsonValue]
    edited: Annotated[str, one_of((A, B))]
    both: bool


class _Link(_Content):
    """Content of a token; that of older links lacks all that has a default."""

    recording: str
    frame: Annotated[int, Field(ge=0, lt=_FRAMES)]
    parameters: dict[str, JsonValue]
    camera: tuple[_Metres, _Metres, _Metres, _Metres, _Metres, _Metres, _Radians] | None = None
    comparison: _Comparison | None = None
    view: LinkedView = LinkedView()
    picked: Annotated[int, Field(ge=0, lt=_CLUSTERS)] | None = None
    plotted: tuple[_Quantity, _Quantity] | None = None
    sensor: _Index | None = None
    zone: tuple[Side, _Index, _Index, _Index] | None = None
    up: tuple[_Metres, _Metres, _Metres] | None = None


def _differences(parameters: Parameters) -> dict[str, Any]:
    """{name: value} of the parameters that differ from the defaults."""
    defaults = to_nested(Parameters())
    return {
        name: value
        for name, value in to_nested(parameters).items()
        if name not in defaults or value != defaults[name]
    }


def _parameters(differences: dict[str, JsonValue]) -> Parameters:
    return from_text(json.dumps(differences), "The link")


def _camera(numbers: tuple[float, float, float, float, float, float, float]) -> Camera:
    """Camera from position, look_at and field of view; ValueError if the first two coincide."""
    x, y, z, a, b, c, fov = numbers
    if math.dist((x, y, z), (a, b, c)) <= 1e-4:
        raise ValueError(numbers)
    return Camera((x, y, z), (a, b, c), fov)


def _direction(up: Vector) -> Vector:
    """The direction; ValueError if it is none."""
    if math.hypot(*up) <= 1e-4:
        raise ValueError(up)
    return up
