"""The text of a rig file that gives a rig again, however that was made."""

import json
import math

import numpy as np
from numpy.typing import NDArray

from robot_assets.rig import Rig, Sensor
from robot_assets.sensor_model import SensorModel


def rig_text(rig: Rig) -> str:
    """A rig as TOML for `load_rig`, each sensor by itself; poses come back to within rounding."""
    parts = [f"name = {_text(rig.name)}\n", _sensor_model(rig.model)]
    return "\n".join([*parts, *(_sensor(sensor) for sensor in rig.sensors)])


def _sensor_model(model: SensorModel) -> str:
    view = _degrees(model.field_of_view)
    if model.vertical_field_of_view is not None:
        view = f"[{view}, {_degrees(model.vertical_field_of_view)}]"
    return (
        "[sensor_model]\n"
        f"name = {_text(model.name)}\n"
        f"rows = {model.rows}\n"
        f"columns = {model.columns}\n"
        f"field_of_view_deg = {view}\n"
        f"min_range_m = {float(model.min_range)!r}\n"
        f"max_range_m = {float(model.max_range)!r}\n"
        f"distance = {_text(model.distance)}\n"
        f"reading_order = {_text(model.reading_order)}\n"
        f"flip_vertical = {_truth(model.flip_vertical)}\n"
        f"flip_horizontal = {_truth(model.flip_horizontal)}\n"
    )


def _sensor(sensor: Sensor) -> str:
    pose = sensor.T_link_sensor
    ring = f"ring = {_text(sensor.ring)}\n" if sensor.ring else ""
    return (
        "[[sensors]]\n"
        f"name = {_text(sensor.name)}\n"
        f"{ring}"
        f"link = {_text(sensor.link)}\n"
        f"position_m = {_vector(pose[:3, 3])}\n"
        f"forward = {_vector(pose[:3, 2])}\n"
        f"up = {_vector(-pose[:3, 1])}\n"
    )


def _text(value: str) -> str:
    # JSON escapes what TOML must have escaped, but for one sign.
    return json.dumps(value, ensure_ascii=False).replace("\x7f", "\\u007f")


def _truth(value: bool) -> str:
    return "true" if value else "false"


def _degrees(angle: float) -> str:
    """An angle in rad as degrees, as a person wrote it where that is the same angle."""
    exact = math.degrees(angle)
    short = round(exact, 9)
    return repr(short if math.radians(short) == angle else exact)


def _vector(values: NDArray[np.float64]) -> str:
    # Adding zero makes a zero of a negative zero.
    return str([value + 0.0 for value in values.tolist()])
