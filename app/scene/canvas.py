"""Interface of the viser objects that a scene can be drawn on."""

from typing import Protocol

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
