"""What a session shows, read back from its client."""

import numpy as np

from app.scene.scene_root import FIXED


def points(client, node):
    return np.array(client.node(f"{FIXED}/{node}").points)


def arrow_count(client):
    return len(points(client, "flow"))


def shown_frame(client) -> int | None:
    """The frame at which the page's timeline is, None before the first."""
    shown = client.shown("timeline.frame")
    return shown[0] if shown else None
