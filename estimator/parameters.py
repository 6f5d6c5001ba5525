"""The parameters of the estimator: one definition for sliders, flags, saved files and documents."""

import math
from dataclasses import dataclass, field, fields
from typing import Any

import numpy as np

from estimator.methods import method_names


class ParameterError(ValueError):
    """A parameter has a value outside its range, or of the wrong type."""


@dataclass(frozen=True)
class ParameterInfo:
    """What a person needs to know about a parameter.

    Attributes:
        text: its meaning in one sentence.
        symbol: how the paper writes it.
        unit: its unit, "" for a plain number.
        low: smallest value accepted.
        high: largest value accepted.
        slider: (smallest, largest, step) offered by a slider, None where there is no slider.
    """

    text: str
    symbol: str = ""
    unit: str = ""
    low: float = -math.inf
    high: float = math.inf
    slider: tuple[float, float, float] | None = None


def _parameter(default: Any, **info: Any) -> Any:  # noqa: ANN401 (a dataclass field of any type)
    return field(default=default, metadata={"info": ParameterInfo(**info)})


@dataclass(frozen=True)
class Parameters:
    """The parameters of an estimate; defaults are the paper's (section III-B) where it gives one.

    The paper leaves `min_cluster_size` and `max_correspondence_distance` open; their defaults
    reproduce its tables best on simulated recordings. Numbers of NumPy become Python's.

    Raises:
        ParameterError: a value is of the wrong type or outside its range; the sentence names it.
    """

    n: int = _parameter(
        8,
        text="frames between the source k-n and the target k",
        symbol="n",
        unit="frames",
        low=1,
        high=1000,
        slider=(1, 20, 1),
    )
    gamma: float = _parameter(
        0.7,
        text="a cluster is classified once its ICP fitness is above this",
        symbol="γ",
        low=0.0,
        high=1.0,
        slider=(0.0, 1.0, 0.01),
    )
    delta: float = _parameter(
        0.04,
        text="a cluster whose mean displacement is below this is stationary",
        symbol="δ",
        unit="m",
        low=0.0,
        high=10.0,
        slider=(0.0, 0.5, 0.005),
    )
    n_min: int = _parameter(
        60,
        text="a cluster with fewer points than this in both clouds is skipped as noise",
        symbol="N_min",
        unit="points",
        low=1,
        high=100_000,
        slider=(1, 200, 1),
    )
    method: str = _parameter("paper", text="the estimator")
    min_cluster_size: int = _parameter(
        20, text="smallest cluster that HDBSCAN forms", unit="points", low=2, high=100_000
    )
    min_samples: int | None = _parameter(
        None,
        text="neighbours of a core point in HDBSCAN; unset means min_cluster_size",
        unit="points",
        low=1,
        high=100_000,
    )
    allow_single_cluster: bool = _parameter(
        False, text="HDBSCAN may put everything into one cluster (one object, nothing else in view)"
    )
    max_correspondence_distance: float = _parameter(
        0.10,
        text="ICP pairs points no further apart than this",
        unit="m",
        low=1e-6,
        high=100.0,
    )
    max_range: float = _parameter(
        4.0,
        text="points further from their sensor than this, along the zone's ray, are left out",
        unit="m",
        low=1e-6,
        high=1000.0,
    )

    def __post_init__(self) -> None:
        for name, info in PARAMETER_INFO.items():
            value = getattr(self, name)
            if isinstance(value, np.generic):  # from an array of values to try; JSON knows none
                value = value.item()
                object.__setattr__(self, name, value)
            _check(name, info, value)


PARAMETER_INFO: dict[str, ParameterInfo] = {f.name: f.metadata["info"] for f in fields(Parameters)}

_OPTIONAL = {f.name for f in fields(Parameters) if f.default is None}
_INTEGERS = {"n", "n_min", "min_cluster_size", "min_samples"}


def _check(name: str, info: ParameterInfo, value: object) -> None:
    if name == "method":
        if value not in method_names():
            raise ParameterError(
                f"method must be one of {', '.join(method_names())}, got {value!r}."
            )
        return
    if name == "allow_single_cluster":
        if not isinstance(value, bool):
            raise ParameterError(f"{name} must be true or false, got {value!r}.")
        return
    if value is None and name in _OPTIONAL:
        return
    kind = "a whole number" if name in _INTEGERS else "a number"
    accepted = int if name in _INTEGERS else (int, float)
    if isinstance(value, bool) or not isinstance(value, accepted):
        raise ParameterError(f"{name} must be {kind}, got {value!r}.")
    if not info.low <= value <= info.high:
        unit = f" {info.unit}" if info.unit else ""
        raise ParameterError(
            f"{name} must be between {info.low:g} and {info.high:g}{unit}, got {value!r}."
        )
