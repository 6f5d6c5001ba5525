"""Saved sessions, which reloads of a page bring back, and links to them."""

import base64
import binascii
import json
import math
from dataclasses import asdict, dataclass, field
from typing import Any

from app.analysis.comparison import Comparison
from app.analysis.parameter_files import from_text
from app.errors import InputError
from app.scene.camera import Camera
from app.scene.settings import ViewSettings
from app.session.clock import Playback
from estimator import Parameters

_LONGEST = 4000  # characters of a link's token
_FARTHEST = 1e5  # metres
_DAMAGED = "The link is damaged; copy it once more."


@dataclass(frozen=True)
class SavedSession:
    """Recording, frame and all that was set, as a session shows them.

    Attributes:
        label: of the recording in the list.
        frame: k.
        parameters: of the estimate.
        camera: of the scene, None where it is not known.
        settings: of the drawing.
        comparison: with a second set of parameters, None where there is none.
        playback: of the recording, None for all of it at its own speed.
        playing: whether time goes on.
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
        """Recording, frame, parameters and camera in letters that an address can hold.

        View settings, comparison and playback stay with the person who has set them.
        """
        defaults = asdict(Parameters())
        content: dict[str, Any] = {"recording": self.label, "frame": self.frame}
        content["parameters"] = {
            name: value
            for name, value in asdict(self.parameters).items()
            if value != defaults[name]
        }
        if self.camera:
            numbers = (*self.camera.position, *self.camera.look_at, self.camera.fov)
            content["camera"] = [round(number, 4) for number in numbers]
        text = json.dumps(content, separators=(",", ":"))
        return base64.urlsafe_b64encode(text.encode()).decode().rstrip("=")


def from_token(token: str) -> SavedSession:
    """Saved session that a token of a link stands for, whatever it is.

    Raises:
        InputError: it stands for none, or its parameters cannot be used.
    """
    if len(token) > _LONGEST:
        raise InputError(_DAMAGED)
    try:
        text = base64.b64decode(token + "=" * (-len(token) % 4), altchars=b"-_", validate=True)
        content: Any = json.loads(text)
        label, frame, parameters = (content[key] for key in ("recording", "frame", "parameters"))
        camera = _camera(content["camera"]) if "camera" in content else None
    except (binascii.Error, ValueError, TypeError, KeyError, RecursionError) as error:
        raise InputError(_DAMAGED) from error
    if not isinstance(label, str) or not isinstance(frame, int) or not isinstance(parameters, dict):
        raise InputError(_DAMAGED)
    return SavedSession(label, frame, from_text(json.dumps(parameters), "The link"), camera)


def _camera(numbers: list[float]) -> Camera:
    """A camera from seven numbers; ValueError or TypeError where they are none."""
    x, y, z, a, b, c, fov = (float(number) for number in numbers)
    camera = Camera((x, y, z), (a, b, c), fov)
    reachable = all(abs(number) < _FARTHEST for number in (x, y, z, a, b, c))
    if not (reachable and 0.01 < fov < 3.0 and math.dist((x, y, z), (a, b, c)) > 1e-4):
        raise ValueError(numbers)
    return camera
