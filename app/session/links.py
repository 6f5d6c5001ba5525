"""Saved sessions, for reloads of the page and for links."""

import base64
import json
import math
from dataclasses import dataclass, field
from typing import Annotated, Any

from pydantic import BaseModel, ConfigDict, Field, JsonValue

from app.analysis.comparison import Comparison
from app.analysis.parameter_files import from_text
from app.errors import InputError
from app.scene.camera import Camera
from app.scene.settings import ViewSettings
from app.session.clock import Playback
from estimator import Parameters, to_nested

_LONGEST = 4000  # characters of a link's token
_FARTHEST = 1e5  # metres
_FRAMES = 10**9  # more than any recording has
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
    """

    label: str
    frame: int
    parameters: Parameters
    camera: Camera | None = None
    settings: ViewSettings = field(default_factory=ViewSettings)
    comparison: Comparison | None = None
    playback: Playback | None = None
    playing: bool = False

    def token(self) -> str:
        """Encode recording, frame, parameters and camera as a URL-safe token.

        View settings, comparison and playback are left out, as personal to the sender.
        """
        defaults = to_nested(Parameters())
        content: dict[str, Any] = {"recording": self.label, "frame": self.frame}
        content["parameters"] = {
            name: value
            for name, value in to_nested(self.parameters).items()
            if name not in defaults or value != defaults[name]
        }
        if self.camera:
            numbers = (*self.camera.position, *self.camera.look_at, self.camera.fov)
            content["camera"] = [round(number, 4) for number in numbers]
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
    except ValueError as error:  # includes those of base64 and pydantic
        raise InputError(_DAMAGED) from error
    parameters = from_text(json.dumps(link.parameters), "The link")
    return SavedSession(link.recording, link.frame, parameters, camera)


_Metres = Annotated[float, Field(gt=-_FARTHEST, lt=_FARTHEST)]
_Radians = Annotated[float, Field(gt=0.01, lt=3.0)]


class _Link(BaseModel):
    """Content of a token, validated strictly."""

    model_config = ConfigDict(strict=True, allow_inf_nan=False)

    recording: str
    frame: Annotated[int, Field(ge=0, lt=_FRAMES)]
    parameters: dict[str, JsonValue]
    camera: tuple[_Metres, _Metres, _Metres, _Metres, _Metres, _Metres, _Radians] | None = None


def _camera(numbers: tuple[float, float, float, float, float, float, float]) -> Camera:
    """Camera from position, look_at and field of view; ValueError if the first two coincide."""
    x, y, z, a, b, c, fov = numbers
    if math.dist((x, y, z), (a, b, c)) <= 1e-4:
        raise ValueError(numbers)
    return Camera((x, y, z), (a, b, c), fov)
