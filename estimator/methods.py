"""Methods by name: a new estimator is registered here, and nothing else changes."""

from collections.abc import Callable
from importlib import import_module
from typing import TYPE_CHECKING, Protocol, cast

if TYPE_CHECKING:
    from estimator.cloud import CloudPair
    from estimator.flow import SceneFlow
    from estimator.parameters import Parameters


class Method(Protocol):
    """What every estimator looks like: a pair of clouds in, a scene flow out."""

    def __call__(self, pair: "CloudPair", parameters: "Parameters") -> "SceneFlow":
        """Estimate the flow of one pair."""
        ...


def _imported(module: str, function: str) -> Callable[[], Method]:
    """Defer an import, so that Open3D is loaded by the first estimate and not by `--help`."""
    return lambda: cast(Method, getattr(import_module(module), function))


_METHODS: dict[str, Callable[[], Method]] = {
    "paper": _imported("estimator.paper", "algorithm_1"),
    "baseline": _imported("estimator.baseline", "baseline"),
}


def method_names() -> tuple[str, ...]:
    """The names of all registered methods, the paper's first."""
    return tuple(_METHODS)


def method(name: str) -> Method:
    """The method registered under `name`; KeyError where there is none."""
    return _METHODS[name]()
