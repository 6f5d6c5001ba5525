"""Interface of the viser objects that a scene can be drawn on."""

from contextlib import AbstractContextManager
from typing import Any, Protocol

import viser


class Canvas(Protocol):
    """A browser client, or a server whose scene is common to all its clients."""

    @property
    def scene(self) -> viser.SceneApi:
        """Scene graph to add nodes to."""
        ...

    @property
    def camera(self) -> viser.CameraHandle | viser.InitialCameraConfig:
        """Camera that views the scene; on a server, its initial pose."""
        ...

    def atomic(self) -> AbstractContextManager[Any]:
        """Context whose changes are drawn at once."""
        ...

    def flush(self) -> None:
        """Send what has been drawn now; otherwise it waits 17 ms for what may follow."""
        ...
