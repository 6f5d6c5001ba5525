"""What is known of a zone, in words and numbers."""

import math

import numpy as np

from app.analysis.answers import Answer, PointAnswer, Vector
from app.analysis.zones import STATUS_WORDS, ZoneState
from app.panels.tables import number
from app.scene.colours import css
from app.scene.palettes import Palette
from estimator import Label

Row = tuple[str, str] | tuple[str, str, str]
"""Name and value, and the colour of a dot before it."""

STATE_WORDS = {
    ZoneState.POINT: "valid",
    ZoneState.NO_TARGET: "no target",
    ZoneState.REFUSED: "refused by its status",
    ZoneState.TOO_FAR: "beyond max range",
    ZoneState.ROBOT: "the robot itself",
    ZoneState.UNPLACED: "pose of the sensor unknown",
    ZoneState.NO_MESSAGE: "no message of the sensor",
    ZoneState.OUTSIDE: "no such zone",
}
"""{what a zone is: in words}."""

_IN_TIME = 5e-4  # seconds; a sensor's stamp this near to the frame's is the same


def title(answer: Answer) -> str:
    """Sensor and zone, such as "elbow/3, row 2, column 5"."""
    return f"{answer.sensor}, row {answer.zone.row}, column {answer.zone.column}"


def rows(answer: Answer, palette: Palette) -> list[Row]:
    """All that is known of a zone and of its point, in the order of the page."""
    found: list[Row] = [("Frame", f"{answer.frame} ({answer.zone.side})")]
    if math.isfinite(answer.along_axis):
        found.append(
            ("Distance", f"{answer.along_axis:.3f} m, {answer.along_ray:.3f} along its ray")
        )
    if answer.point is None:
        found.append(("No point", STATE_WORDS[answer.state]))
    if answer.status is not None:
        words = STATUS_WORDS.get(answer.status, "unknown")
        found.append(("Status", f"{answer.status}: {words}"))
    found.append(("Read", read_at(answer.lateness)))
    if answer.point is not None:
        found += _about(answer.point, palette)
    return found


def read_at(lateness: float) -> str:
    """When a sensor was read, from the seconds between the frame's stamp and its own."""
    milliseconds = f"{1e3 * abs(lateness):.0f} ms"
    if math.isnan(lateness):
        return "not yet in this recording"
    if lateness < 0:
        return f"not in this frame, last {milliseconds} before"
    return (
        "at the frame's stamp" if lateness < _IN_TIME else f"{milliseconds} after the frame's stamp"
    )


def _about(point: PointAnswer, palette: Palette) -> list[Row]:
    x, y, z = (number(value, ".3f") for value in point.position)
    found: list[Row] = [("Position", f"{x}, {y}, {z} m")]
    found.append(("Cluster", "none" if point.cluster is None else str(point.cluster)))
    if point.label is not None:
        found.append(("Label", point.label.name.lower(), css(_colour(point.label, palette))))
    if point.velocity is not None:
        found.append(("Velocity", _velocity(point.velocity)))
    if point.cluster_velocity is not None:
        found.append(("Cluster's mean", _velocity(point.cluster_velocity)))
    if point.truth is not None:
        truth = _velocity(point.truth) if point.truly_moves else "at rest"
        found.append(("True velocity", truth))
    if point.error is not None:
        found.append(("Error", f"{point.error:.3f} m/s"))
    elif point.truly_moves and point.label is not None and point.label != Label.MOVING:
        found.append(("Error", "it moves and has no velocity"))
    return found


def _velocity(velocity: Vector) -> str:
    x, y, z = (number(round(value, 2) + 0.0, ".2f") for value in velocity)
    return f"{np.linalg.norm(velocity):.3f} m/s ({x}, {y}, {z})"


def _colour(label: Label, palette: Palette) -> tuple[int, int, int]:
    by_label = {Label.MOVING: palette.source, Label.STATIONARY: palette.stationary}
    return by_label.get(label, palette.unassigned)
