"""Schema of a rig file, for reading and writing."""

from typing import Annotated, Literal, LiteralString, Self

import numpy as np
from pydantic import (
    AfterValidator,
    BaseModel,
    ConfigDict,
    Field,
    GetPydanticSchema,
    ValidationInfo,
    field_validator,
    model_validator,
)
from pydantic_core import PydanticCustomError, core_schema

from robot_assets.rig_names import name_conflict
from robot_assets.sensor_model import unit

MAX_SENSORS = 1000
MAX_RANGE = 100.0
"""Metres, ten times the range of any such sensor."""
_MAX_COORDINATE = 1e6
"""Far above any coordinate of a rig; squares of much larger numbers overflow."""
WRONG_VALUE, WRONG_RIG = "wrong_value", "wrong_rig"
"""Types of our own errors: of a key's value, and of the rig as a whole."""


def _must_be(expected: str) -> GetPydanticSchema:
    """Replace all errors of a value by one that names what is expected."""
    return GetPydanticSchema(
        lambda source, handler: core_schema.custom_error_schema(
            handler(source), WRONG_VALUE, custom_error_message=f"must be {expected}"
        )
    )


def _error(kind: LiteralString, message: str) -> PydanticCustomError:
    # The message is a value of the template: names of a rig may contain braces.
    return PydanticCustomError(kind, "{message}", {"message": message})


def _not_zero(vector: list[float]) -> list[float]:
    if np.linalg.norm(vector) < 1e-9:
        raise _error(WRONG_VALUE, "must be a direction, not zero")
    return vector


def _not_along(axis: list[float] | None, vector: list[float]) -> list[float]:
    if axis is not None:
        along = unit(np.array(axis))
        if np.linalg.norm(np.cross(along, vector)) < 1e-6 * np.linalg.norm(vector):
            raise _error(WRONG_VALUE, f"must be a direction that is not along {along.tolist()}")
    return vector


_Text = Annotated[str, Field(min_length=1), _must_be("a text")]
_Flag = Annotated[bool, _must_be("true or false")]
_Zones = Annotated[int, Field(ge=2, le=64), _must_be("a whole number from 2 to 64")]
_Angle = Annotated[float, Field(ge=1, le=170)]
_Angles = Annotated[
    _Angle | Annotated[list[_Angle], Field(min_length=1, max_length=2)],
    _must_be("a number from 1 to 170, or two of them"),
]
_Vector = Annotated[
    list[Annotated[float, Field(ge=-_MAX_COORDINATE, le=_MAX_COORDINATE)]],
    Field(min_length=3, max_length=3),
    _must_be("three numbers"),
]
_Direction = Annotated[_Vector, AfterValidator(_not_zero)]


class FileTable(BaseModel):
    """Table of a rig file; unknown keys and values of a wrong type are errors."""

    model_config = ConfigDict(strict=True, extra="forbid", frozen=True, allow_inf_nan=False)


class SensorModelTable(FileTable):
    """Table [sensor_model]; keys as in `SensorModel`."""

    name: _Text
    rows: _Zones
    columns: _Zones
    field_of_view_deg: _Angles
    min_range_m: Annotated[
        float, Field(ge=0, le=MAX_RANGE), _must_be(f"a number from 0 to {MAX_RANGE:g}")
    ]
    max_range_m: Annotated[
        float,
        Field(ge=0.001, le=MAX_RANGE),
        _must_be(f"a number from 0.001 to {MAX_RANGE:g}"),
    ]
    distance: Annotated[Literal["perpendicular", "radial"], _must_be('"perpendicular" or "radial"')]
    reading_order: Annotated[
        Literal["row_major", "column_major"], _must_be('"row_major" or "column_major"')
    ]
    flip_vertical: _Flag
    flip_horizontal: _Flag

    @field_validator("max_range_m")
    @classmethod
    def _not_below_min_range(cls, value: float, info: ValidationInfo) -> float:
        low: float = info.data.get("min_range_m", 0.0)
        if value < low:
            raise _error(WRONG_VALUE, f"must be a number from {low:g} to {MAX_RANGE:g}")
        return value


class RingTable(FileTable):
    """Table of [[rings]]: sensors around an axis, counter-clockwise from `first_direction`."""

    name: _Text
    link: _Text
    count: Annotated[
        int, Field(ge=1, le=MAX_SENSORS), _must_be(f"a whole number from 1 to {MAX_SENSORS}")
    ]
    radius_m: Annotated[float, Field(ge=0, le=10), _must_be("a number from 0 to 10")]
    centre_m: _Vector
    axis: _Direction
    first_direction: _Direction

    @field_validator("first_direction")
    @classmethod
    def _not_along_the_axis(cls, value: list[float], info: ValidationInfo) -> list[float]:
        return _not_along(info.data.get("axis"), value)

    @property
    def sensor_names(self) -> list[str]:
        """Names of its sensors, in order."""
        return [f"{self.name}/{i}" for i in range(self.count)]


class SingleTable(FileTable):
    """Table of [[sensors]]: one sensor."""

    name: _Text
    ring: _Text | None = None
    link: _Text
    position_m: _Vector
    forward: _Direction
    up: _Direction

    @field_validator("up")
    @classmethod
    def _not_along_forward(cls, value: list[float], info: ValidationInfo) -> list[float]:
        return _not_along(info.data.get("forward"), value)


class RigFile(FileTable):
    """Whole rig file."""

    name: _Text
    sensor_model: SensorModelTable
    rings: list[RingTable] = []
    sensors: list[SingleTable] = []

    @model_validator(mode="after")
    def _count_and_names_are_valid(self) -> Self:
        count = sum(ring.count for ring in self.rings) + len(self.sensors)
        if count == 0:
            raise _error(
                WRONG_RIG, "there must be at least one of [[rings]] and [[sensors]], found none"
            )
        if count > MAX_SENSORS:
            raise _error(WRONG_RIG, f"there must be at most {MAX_SENSORS} sensors, found {count}")
        names = [name for ring in self.rings for name in ring.sensor_names]
        if conflict := name_conflict([*names, *(single.name for single in self.sensors)]):
            raise _error(WRONG_RIG, conflict)
        return self
