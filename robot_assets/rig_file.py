"""Validated models of a rig file, for reading and writing."""

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

MOST_SENSORS = 1000
LONGEST_RANGE = 100.0
"""Metres, ten times the range of any such sensor."""
_LARGEST = 1e6
"""No measure of a rig is this large; squares of much larger numbers overflow."""
EXPECTED, WHOLE = "expected", "whole"
"""Types of our own errors: of a key's value, and of a rig as a whole."""


def _must_be(expected: str) -> GetPydanticSchema:
    """Replace all errors of a value by one that says what is expected."""
    return GetPydanticSchema(
        lambda source, handler: core_schema.custom_error_schema(
            handler(source), EXPECTED, custom_error_message=f"must be {expected}"
        )
    )


def _wrong(kind: LiteralString, said: str) -> PydanticCustomError:
    # As a value, since names of a rig may contain the braces of a template.
    return PydanticCustomError(kind, "{said}", {"said": said})


def _not_zero(vector: list[float]) -> list[float]:
    if np.linalg.norm(vector) < 1e-9:
        raise _wrong(EXPECTED, "must be a direction, not zero")
    return vector


def _across(vector: list[float], axis: list[float] | None) -> list[float]:
    if axis is not None:
        along = unit(np.array(axis))
        if np.linalg.norm(np.cross(along, vector)) < 1e-6 * np.linalg.norm(vector):
            raise _wrong(EXPECTED, f"must be a direction that is not along {along.tolist()}")
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
    list[Annotated[float, Field(ge=-_LARGEST, le=_LARGEST)]],
    Field(min_length=3, max_length=3),
    _must_be("three numbers"),
]
_Direction = Annotated[_Vector, AfterValidator(_not_zero)]


class FileTable(BaseModel):
    """Table of a rig file; unknown keys and values of another type are errors."""

    model_config = ConfigDict(strict=True, extra="forbid", frozen=True, allow_inf_nan=False)


class SensorModelTable(FileTable):
    """Table [sensor_model]; keys as in `SensorModel`."""

    name: _Text
    rows: _Zones
    columns: _Zones
    field_of_view_deg: _Angles
    min_range_m: Annotated[
        float, Field(ge=0, le=LONGEST_RANGE), _must_be(f"a number from 0 to {LONGEST_RANGE:g}")
    ]
    max_range_m: Annotated[
        float,
        Field(ge=0.001, le=LONGEST_RANGE),
        _must_be(f"a number from 0.001 to {LONGEST_RANGE:g}"),
    ]
    distance: Annotated[Literal["perpendicular", "radial"], _must_be('"perpendicular" or "radial"')]
    reading_order: Annotated[
        Literal["row_major", "column_major"], _must_be('"row_major" or "column_major"')
    ]
    flip_vertical: _Flag
    flip_horizontal: _Flag

    @field_validator("max_range_m")
    @classmethod
    def _not_below_the_smallest(cls, value: float, info: ValidationInfo) -> float:
        low: float = info.data.get("min_range_m", 0.0)
        if value < low:
            raise _wrong(EXPECTED, f"must be a number from {low:g} to {LONGEST_RANGE:g}")
        return value


class RingTable(FileTable):
    """Table of [[rings]]: sensors around an axis, counter-clockwise from `first_direction`."""

    name: _Text
    link: _Text
    count: Annotated[
        int, Field(ge=1, le=MOST_SENSORS), _must_be(f"a whole number from 1 to {MOST_SENSORS}")
    ]
    radius_m: Annotated[float, Field(ge=0, le=10), _must_be("a number from 0 to 10")]
    centre_m: _Vector
    axis: _Direction
    first_direction: _Direction

    @field_validator("first_direction")
    @classmethod
    def _not_along_the_axis(cls, value: list[float], info: ValidationInfo) -> list[float]:
        return _across(value, info.data.get("axis"))

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
        return _across(value, info.data.get("forward"))


class RigFile(FileTable):
    """Whole rig file."""

    name: _Text
    sensor_model: SensorModelTable
    rings: list[RingTable] = []
    sensors: list[SingleTable] = []

    @model_validator(mode="after")
    def _sensors_can_be_told_apart(self) -> Self:
        count = sum(ring.count for ring in self.rings) + len(self.sensors)
        if count == 0:
            raise _wrong(
                WHOLE, "there must be at least one of [[rings]] and [[sensors]], found none"
            )
        if count > MOST_SENSORS:
            raise _wrong(WHOLE, f"there must be at most {MOST_SENSORS} sensors, found {count}")
        names = [name for ring in self.rings for name in ring.sensor_names]
        if conflict := name_conflict([*names, *(single.name for single in self.sensors)]):
            raise _wrong(WHOLE, conflict)
        return self
