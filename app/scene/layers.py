"""Layers of the drawing: the nodes that each shows or hides."""

from collections.abc import Collection

import viser

from app.scene.clouds_view import (
    FLOW_NODE,
    SECOND_FLOW_NODE,
    SOURCE_NODE,
    STATIC_SOURCE_NODE,
    STATIC_TARGET_NODE,
    TARGET_NODE,
    TRUTH_NODE,
)
from app.scene.robot_view import ROOT
from app.scene.scene_root import AXES
from app.scene.sensors_view import FRUSTUMS, SENSORS
from app.scene.surroundings import GRID_AND_AXES
from app.scene.true_object import TRUE_OBJECT

_NODES = {
    "Robot": (ROOT,),
    "Sensors": (SENSORS,),
    "Frustums": (FRUSTUMS,),
    "Source": (SOURCE_NODE, STATIC_SOURCE_NODE),
    "Target": (TARGET_NODE, STATIC_TARGET_NODE),
    "Flow": (FLOW_NODE, SECOND_FLOW_NODE),
    "Truth": (TRUTH_NODE,),
    "True object": (TRUE_OBJECT,),
    GRID_AND_AXES: (AXES,),
}
"""{layer: nodes that it shows or hides}."""


def show_layers(scene: viser.SceneApi, layers: Collection[str]) -> None:
    """Show the nodes of these layers, and hide those of all others; the floor has its own rule."""
    for layer, names in _NODES.items():
        for name in names:
            if node := scene.get_handle_by_name(name):
                node.visible = layer in layers
