"""Declaration and validation of parameters: meaning, unit, range and slider beside each field."""

import math
from dataclasses import MISSING, dataclass, field, fields, replace
from functools import cache
from typing import Any, get_args, get_type_hints

import numpy as np
from pydantic_core import SchemaValidator, ValidationError, core_schema

_KINDS = {int: "a whole number", float: "a number", bool: "true or false", str: "a text"}


class ParameterError(ValueError):
    """Parameter value outside its range or of the wrong type."""


@dataclass(frozen=True)
class ParameterInfo:
    """Description of a parameter, from which sliders, flags, files and documents are made.

    Attributes:
        text: its meaning in one sentence.
        symbol: how the paper writes it.
        unit: its unit, "" for a plain number.
        low: smallest value accepted.
        high: largest value accepted.
        slider: (smallest, largest, step), None for no slider.
        choices: accepted texts, empty where any text is.
        kind: type of its values: int, float, bool or str; taken from the field's annotation.
        optional: whether it may be unset (None); taken from the field's annotation.
        default: default value; taken from the field.
    """

    text: str
    symbol: str = ""
    unit: str = ""
    low: float = -math.inf
    high: float = math.inf
    slider: tuple[float, float, float] | None = None
    choices: tuple[str, ...] = ()
    kind: type = float
    optional: bool = False
    default: Any = None

    @property
    def kind_text(self) -> str:
        """The type of its values in words."""
        return _KINDS[self.kind]


def parameter(
    default: Any,  # noqa: ANN401 (a dataclass field of any type)
    *,
    text: str,
    symbol: str = "",
    unit: str = "",
    low: float = -math.inf,
    high: float = math.inf,
    slider: tuple[float, float, float] | None = None,
    choices: tuple[str, ...] = (),
) -> Any:  # noqa: ANN401
    """Declare a field of a parameter dataclass; arguments as in `ParameterInfo`."""
    declared = ParameterInfo(text, symbol, unit, low, high, slider, choices)
    return field(default=default, metadata={"parameter": declared})


@cache
def infos_of(declaring: type) -> dict[str, ParameterInfo]:
    """{name: description} of the parameters that a dataclass declares, in order.

    Raises:
        TypeError: a field is not an int, float, bool or str, or has no default.
    """
    hints = get_type_hints(declaring)
    found: dict[str, ParameterInfo] = {}
    for each in fields(declaring):
        declared: ParameterInfo | None = each.metadata.get("parameter")
        if declared is None:
            continue
        types = get_args(hints[each.name]) or (hints[each.name],)
        optional = type(None) in types
        kinds = [kind for kind in types if kind is not type(None)]
        if len(kinds) != 1 or kinds[0] not in _KINDS or each.default is MISSING:
            raise TypeError(
                f"{declaring.__name__}.{each.name} must be int, float, bool or str, optionally "
                f"None, with a default; got {hints[each.name]}."
            )
        if optional and not declared.low > 0:
            raise TypeError(
                f"{declaring.__name__}.{each.name} may be unset, for which controls show 0; its "
                "range must begin above 0."
            )
        found[each.name] = replace(declared, kind=kinds[0], optional=optional, default=each.default)
    return found


class CheckedParameters:
    """Base of frozen dataclasses whose fields are declared with `parameter`.

    Values are checked on construction; NumPy numbers become Python's.

    Raises:
        ParameterError: a value is of the wrong type or outside its range; the sentence names it.
    """

    def __post_init__(self) -> None:
        for name, info in infos_of(type(self)).items():
            value = getattr(self, name)
            if isinstance(value, np.generic):  # JSON cannot hold NumPy numbers
                value = value.item()
            object.__setattr__(self, name, checked(name, value, info))


def checked(name: str, value: object, info: ParameterInfo) -> Any:  # noqa: ANN401
    """Check a parameter's value and convert it to its type.

    Raises:
        ParameterError: it is of the wrong type or outside its range.
    """
    if value is None and info.optional:
        return None
    try:
        return _validator(info).validate_python(value)
    except ValidationError as error:
        raise ParameterError(_sentence(name, value, info, error)) from None


@cache
def _validator(info: ParameterInfo) -> SchemaValidator:
    low, high = (bound if math.isfinite(bound) else None for bound in (info.low, info.high))
    if info.choices:
        schema = core_schema.literal_schema([*info.choices])
    elif info.kind is bool:
        schema = core_schema.bool_schema(strict=True)
    elif info.kind is str:
        schema = core_schema.str_schema(strict=True)
    elif info.kind is int:
        low, high = (None if bound is None else int(bound) for bound in (low, high))
        schema = core_schema.int_schema(strict=True, ge=low, le=high)
    else:
        schema = core_schema.float_schema(strict=True, ge=low, le=high, allow_inf_nan=False)
    return SchemaValidator(schema)


def _sentence(name: str, value: object, info: ParameterInfo, error: ValidationError) -> str:
    if info.choices:
        return f"{name} must be one of {', '.join(info.choices)}, got {value!r}."
    if error.errors()[0]["type"] in ("greater_than_equal", "less_than_equal", "finite_number"):
        unit = f" {info.unit}" if info.unit else ""
        if math.isinf(info.low) and math.isinf(info.high):
            return f"{name} must be a finite number, got {value!r}."
        return f"{name} must be between {info.low:g} and {info.high:g}{unit}, got {value!r}."
    return f"{name} must be {info.kind_text}, got {value!r}."
