"""Scene nodes of a session, read back from its client."""

import numpy as np

from app.scene.scene_root import FIXED


def points(client, node):
    return np.array(client.node(f"{FIXED}/{node}").points)


def arrow_count(client):
    return len(points(client, "flow"))
