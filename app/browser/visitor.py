"""What one client sends: what is handled, what is left out, and when its connection is ended."""

import math
import traceback
from collections.abc import Callable, Sequence
from pathlib import Path

import viser

from app.browser.connections import (
    CommandTriggerMessage,
    FileTransferPart,
    FileTransferStartUpload,
    GetRenderResponseMessage,
    GuiUpdateMessage,
    LocalStorageGetItemResponseMessage,
    ScenePointerMessage,
    Unreadable,
    ViewerCameraMessage,
    accepts_files,
    end_upload,
)
from app.browser.rubbish import RubbishLog
from app.browser.uploads import LARGEST_UPLOAD, Part, Uploads

_ENDURED = 100  # messages that cannot be understood, after which the connection is ended
_LONGEST = 10_000  # characters that are typed into a field
_FARTHEST = 1e9  # metres
_WIDEST = 100_000  # pixels

_TOO_LARGE = (
    "{name} has {size:,} bytes, but not more than {limit:,} can be uploaded at a time; choose a "
    "smaller file."
)


class Visitor:
    """Decides about the messages of one client.

    Args:
        client: its handle, None before it is made.
        end: ends its connection.
        log: tells of messages that could not be understood.
    """

    def __init__(
        self,
        client: Callable[[], viser.ClientHandle | None],
        end: Callable[[], None],
        log: RubbishLog,
    ) -> None:
        self._client, self._end, self._log = client, end, log
        self._uploads = Uploads()
        self._misunderstood, self._last = 0, ""

    def admits(self, message: object) -> bool:
        """Whether a message is handled.

        Kinds that a page of this app does not send, such as requests to make the server public, are
        left out.
        """
        if self._misunderstood >= _ENDURED:
            return False
        if isinstance(message, Unreadable):
            self.failed(message.error)
            return False
        try:
            return self._understood(message)
        except Exception as error:  # of whatever types are in there
            self.failed(error)
            return False

    def failed(self, error: Exception) -> None:
        """Count a message that could not be understood; the connection ends if they are many."""
        self._misunderstood += 1
        self._last = _what_and_where(error)
        if self._misunderstood == _ENDURED:
            self._end()

    def leave(self) -> None:
        """Log what could not be understood."""
        if self._misunderstood:
            ended = self._misunderstood >= _ENDURED
            self._log.note(self._misunderstood, self._last, ended=ended)

    def _understood(self, message: object) -> bool:
        """Whether to handle it; ValueError or any other where a page sends no such thing."""
        match message:
            case ViewerCameraMessage():
                _check_camera(message)
            case ScenePointerMessage():
                _check_pointer(message)
            case GuiUpdateMessage(updates=updates):
                (name,) = updates
                _check(name == "value", "a page sets values alone")
                _check_value(updates["value"])
            case LocalStorageGetItemResponseMessage(value=value, error=error):
                _check(value is None or isinstance(value, str), "no text")
                _check(error is None or isinstance(error, str), "no text")
            case GetRenderResponseMessage(payload=payload):
                _check(isinstance(payload, bytes), "no bytes")
            case CommandTriggerMessage():
                pass
            case FileTransferStartUpload():
                return self._begins(message)
            case FileTransferPart():
                return self._takes(message)
            case _:
                return False
        return True

    def _begins(self, message: FileTransferStartUpload) -> bool:
        client = self._client()
        source, size = message.source_component_uuid, message.size_bytes
        _check(client is not None and accepts_files(client, source), "nothing takes files there")
        assert client is not None
        _check(len(message.filename) < 1000, "too long")
        if self._uploads.begin(f"{source} {message.transfer_uuid}", message.part_count, size):
            return True
        said = _TOO_LARGE.format(name=message.filename, size=size, limit=LARGEST_UPLOAD)
        end_upload(client, message)
        client.add_notification("Upload", said, color="red", auto_close_seconds=15)
        return False

    def _takes(self, message: FileTransferPart) -> bool:
        upload = f"{message.source_component_uuid} {message.transfer_uuid}"
        part = self._uploads.take(upload, message.part_index, len(message.content))
        _check(part is not Part.UNEXPECTED, "a part of no file")
        return part is Part.TAKEN


def _check_camera(message: ViewerCameraMessage) -> None:
    _check_vector(message.wxyz, 4)
    for vector in (message.position, message.look_at, message.up_direction):
        _check_vector(vector, 3)
    _check(0 < message.fov < math.pi, "no angle of view")
    _check_vector((message.near, message.far), 2)
    width, height = message.image_width, message.image_height
    _check(0 <= width <= _WIDEST and 0 <= height <= _WIDEST, "no picture's size")


def _check_pointer(message: ScenePointerMessage) -> None:
    _check(message.event_type == "click", "the page knows clicks alone")
    for vector in (message.ray_origin, message.ray_direction):
        assert vector is not None
        _check_vector(vector, 3)
    assert message.ray_direction is not None
    _check(max(map(abs, message.ray_direction)) > 1e-6, "no direction")


def _check_vector(vector: Sequence[float], size: int) -> None:
    fine = len(vector) == size and all(abs(number) < _FARTHEST for number in vector)
    _check(fine, f"not {size} numbers")  # NaN is not below anything


def _check_value(value: object) -> None:
    match value:
        case float():
            _check(math.isfinite(value), "no number")
        case str():
            _check(len(value) <= _LONGEST, "too long")
        case list() | tuple():
            _check(len(value) <= _LONGEST, "too long")
            for one in value:
                _check(isinstance(one, int | float | str), "lists of lists")
                _check_value(one)


def _check(fine: bool, otherwise: str) -> None:
    if not fine:
        raise ValueError(otherwise)


def _what_and_where(error: Exception) -> str:
    place = traceback.extract_tb(error.__traceback__)[-1:]
    where = "".join(f" at line {frame.lineno} of {Path(frame.filename).name}" for frame in place)
    return f"{type(error).__name__}{where}"
