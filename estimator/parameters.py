"""Parameters of an estimate: the single definition for sliders, flags, files and documents."""

from dataclasses import dataclass
from typing import Any, TypeVar

from estimator.parameter_info import (
    CheckedParameters,
    ParameterError,
    ParameterInfo,
    infos_of,
    parameter,
)

T = TypeVar("T", bound=CheckedParameters)

_METHODS: dict[str, None] = {}


def add_method_name(name: str) -> None:
    """Allow a name as `Parameters.method`; called by `estimator.method.register`."""
    _METHODS[name] = None


def method_names() -> tuple[str, ...]:
    """Names of all registered methods, the paper's first."""
    return tuple(_METHODS)


@dataclass(frozen=True)
class Parameters(CheckedParameters):
    """Parameters of an estimate; defaults are the paper's (section III-B) where it gives one.

    The paper leaves `min_cluster_size` and `max_correspondence_distance` open; their defaults
    reproduce its tables best on simulated recordings. NumPy numbers become Python's.

    Attributes:
        own: methods' own parameters, one instance per class; instances that equal their defaults
            are dropped, so that parameters with equal values compare equal.

    Raises:
        ParameterError: a value is of the wrong type or outside its range; the sentence names it.
    """

    n: int = parameter(
        8,
        text="frames between the source k-n and the target k",
        symbol="n",
        unit="frames",
        low=1,
        high=1000,
        slider=(1, 20, 1),
    )
    gamma: float = parameter(
        0.7,
        text="a cluster is classified once its ICP fitness is above this",
        symbol="γ",
        low=0.0,
        high=1.0,
        slider=(0.0, 1.0, 0.01),
    )
    delta: float = parameter(
        0.04,
        text="a cluster whose mean displacement is below this is stationary",
        symbol="δ",
        unit="m",
        low=0.0,
        high=10.0,
        slider=(0.0, 0.5, 0.005),
    )
    n_min: int = parameter(
        60,
        text="a cluster with fewer points than this in both clouds is skipped as noise",
        symbol="N_min",
        unit="points",
        low=1,
        high=100_000,
        slider=(1, 200, 1),
    )
    method: str = parameter("paper", text="the estimator")
    min_cluster_size: int = parameter(
        20, text="smallest cluster that HDBSCAN forms", unit="points", low=2, high=100_000
    )
    min_samples: int | None = parameter(
        None,
        text="neighbours of a core point in HDBSCAN; unset means min_cluster_size",
        unit="points",
        low=1,
        high=100_000,
    )
    allow_single_cluster: bool = parameter(
        False, text="HDBSCAN may put everything into one cluster (one object, nothing else in view)"
    )
    max_correspondence_distance: float = parameter(
        0.10,
        text="ICP pairs points no further apart than this",
        unit="m",
        low=1e-6,
        high=100.0,
    )
    max_range: float = parameter(
        4.0,
        text="points further from their sensor than this, along the zone's ray, are left out",
        unit="m",
        low=1e-6,
        high=1000.0,
    )
    own: tuple[Any, ...] = ()

    def __post_init__(self) -> None:
        if not isinstance(self.method, str) or self.method not in _METHODS:
            raise ParameterError(
                f"method must be one of {', '.join(_METHODS)}, got {self.method!r}."
            )
        super().__post_init__()
        own_parameters = tuple(self.own) if isinstance(self.own, list | tuple) else (self.own,)
        if wrong := [own for own in own_parameters if not isinstance(own, CheckedParameters)]:
            raise ParameterError(f"own must hold parameters of methods, got {wrong[0]!r}.")
        by_class = {type(own): own for own in own_parameters if own != type(own)()}
        ordered = sorted(by_class, key=lambda kind: (kind.__module__, kind.__qualname__))
        object.__setattr__(self, "own", tuple(by_class[kind] for kind in ordered))

    def of(self, kind: type[T]) -> T:
        """Instance of a method's own parameter class, with its defaults where none was set."""
        return next((own for own in self.own if type(own) is kind), None) or kind()


PARAMETER_INFO: dict[str, ParameterInfo] = infos_of(Parameters)
