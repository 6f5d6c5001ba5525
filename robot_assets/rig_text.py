"""Writing a rig as the text of a rig file."""

import json
import math
from typing import Any

from pydantic import ValidationError

from robot_assets.rig import Rig, RigError, Sensor
from robot_assets.rig_file import RigFile
from robot_assets.rig_problems import problems
from robot_assets.sensor_model import SensorModel


def rig_text(rig: Rig) -> str:
    """Rig as TOML for `load_rig`, rings as single sensors; poses are kept to within rounding.

    Raises:
        RigError: a value of a rig made in code is not valid in a file.
    """
    content = {
        "name": rig.name,
        "sensor_model": _sensor_model(rig.model),
        "sensors": [_sensor(sensor) for sensor in rig.sensors],
    }
    try:
        checked = RigFile.model_validate(content)
    except ValidationError as error:
        raise RigError(f"No file can hold the rig {rig.name!r}: {problems(error)}") from error
    return _toml(checked.model_dump(exclude_defaults=True))


def _sensor_model(model: SensorModel) -> dict[str, Any]:
    across, down = model.field_of_view, model.vertical_field_of_view
    return {
        "name": model.name,
        "rows": model.rows,
        "columns": model.columns,
        "field_of_view_deg": (
            _degrees(across) if down is None else [_degrees(across), _degrees(down)]
        ),
        "min_range_m": model.min_range,
        "max_range_m": model.max_range,
        "distance": model.distance,
        "reading_order": model.reading_order,
        "flip_vertical": model.flip_vertical,
        "flip_horizontal": model.flip_horizontal,
    }


def _sensor(sensor: Sensor) -> dict[str, Any]:
    pose = sensor.T_link_sensor
    return {
        "name": sensor.name,
        "ring": sensor.ring or None,
        "link": sensor.link,
        "position_m": pose[:3, 3].tolist(),
        "forward": pose[:3, 2].tolist(),
        "up": (-pose[:3, 1]).tolist(),
    }


def _degrees(angle: float) -> float:
    """Angle in rad as degrees, rounded where that is the same angle."""
    exact = math.degrees(angle)
    short = round(exact, 9)
    return short if math.radians(short) == angle else exact


def _toml(table: dict[str, Any]) -> str:
    """Lines of a table: its plain values, then the tables inside it."""
    text = ""
    for key, value in table.items():
        if isinstance(value, dict):
            text += f"\n[{key}]\n{_toml(value)}"
        elif isinstance(value, list) and isinstance(value[0], dict):
            text += "".join(f"\n[[{key}]]\n{_toml(one)}" for one in value)
        else:
            text += f"{key} = {_value(value)}\n"
    return text


def _value(value: str | bool | float | list[float]) -> str:
    if isinstance(value, str):
        # JSON escapes all that TOML requires, except DEL.
        return json.dumps(value, ensure_ascii=False).replace("\x7f", "\\u007f")
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, list):
        return f"[{', '.join(map(_value, value))}]"
    # Adding zero turns -0.0 into 0.0.
    return repr(value + 0)
