"""What a scene is drawn on."""

from typing import Protocol

import viser


class Canvas(Protocol):
    """A browser client, or a server whose scene all its clients see."""

    @property
    def scene(self) -> viser.SceneApi:
        """Where things are drawn."""
        ...

    @property
    def camera(self) -> viser.CameraHandle | viser.InitialCameraConfig:
        """From where they are seen, at first."""
        ...
