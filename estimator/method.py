"""Descriptions of methods, trackers, and the registry of methods by name."""

from collections.abc import Callable
from dataclasses import dataclass, field, is_dataclass
from typing import Protocol

from estimator.flow import SceneFlow
from estimator.parameter_info import (
    CheckedParameters,
    ParameterError,
    ParameterInfo,
    infos_of,
)
from estimator.parameters import PARAMETER_INFO, Parameters, add_method_name
from estimator.window import Window

SHARED = ("n", "max_range")
"""Parameters of every method."""


class MethodError(Exception):
    """Method that cannot be registered, or that fails."""


class Tracker(Protocol):
    """Method with memory: it is given the windows of frames k, k+1, k+2 ... in order."""

    def step(self, window: Window) -> SceneFlow:
        """Estimate the flow of the next window, whose last frame is one further."""
        ...


@dataclass(frozen=True)
class Method:
    """Scene flow method.

    A method has either a `flow`, a pure function: the same window and parameters give the same
    flow, from any thread; or a `tracker`, which is run over fixed segments of a recording, each
    begun `warm_up` steps early, so that a frame's flow does not depend on the order in which
    frames are requested.

    Attributes:
        name: unique; the value of `Parameters.method` and `--method`.
        flow: estimates a window's flow.
        tracker: makes a tracker with an empty memory.
        title: name in tables and figures; default `name`.
        parameters: class of its own parameters, declared with `parameter`, None where it has none.
            `Parameters.of` returns an instance of it.
        uses: fields of `Parameters` that change its results.
        warm_up: steps after which a tracker's flow is used.
        needs_rays: whether it needs the rays of sensors, which plain points do not have.
    """

    name: str
    flow: Callable[[Window, Parameters], SceneFlow] | None = None
    tracker: Callable[[Parameters], Tracker] | None = None
    title: str = ""
    parameters: type[CheckedParameters] | None = None
    uses: tuple[str, ...] = SHARED
    warm_up: int = 0
    needs_rays: bool = field(default=False)

    @property
    def label(self) -> str:
        """Name in tables and figures."""
        return self.title or self.name

    def infos(self) -> dict[str, ParameterInfo]:
        """{name: description} of all parameters that change its results.

        Its own are named by method and field, such as `rays.sigma`.
        """
        shared = {name: PARAMETER_INFO[name] for name in PARAMETER_INFO if name in self.uses}
        own = infos_of(self.parameters) if self.parameters else {}
        return shared | {f"{self.name}.{name}": info for name, info in own.items()}


_METHODS: dict[str, Method] = {}


def register(method: Method) -> None:
    """Register a method under its name.

    Raises:
        MethodError: the name is taken or not valid, a field in `uses` does not exist, or the
            method does not have exactly one of flow and tracker.
    """
    name = method.name
    if name in _METHODS and _METHODS[name] != method:
        raise MethodError(f"There is a method {name} already; give this one another name.")
    if any(_flag(name) == _flag(other) for other in _METHODS if other != name):
        raise MethodError(f"The flags of method {name} would be another's; give it another name.")
    if (method.flow is None) == (method.tracker is None):
        raise MethodError(f"Method {name} must have either a flow or a tracker.")
    if not name.replace("_", "").replace("-", "").isalnum() or name in PARAMETER_INFO:
        raise MethodError(
            f"A method's name is made of letters, digits, dashes and underscores, and is none of "
            f"{', '.join(PARAMETER_INFO)}; got {name!r}."
        )
    if unknown := [used for used in method.uses if used not in PARAMETER_INFO]:
        raise MethodError(f"Method {name} uses {unknown[0]}, which is no field of Parameters.")
    if method.parameters is not None:
        _check_own_parameters(method, method.parameters)
    _METHODS[name] = method
    add_method_name(name)


def _flag(name: str) -> str:
    return name.replace("_", "-").lower()


def _check_own_parameters(method: Method, own: type[CheckedParameters]) -> None:
    """Raise MethodError where a method's own parameters are not declared as they must be."""
    where = f"The parameters {own.__name__} of method {method.name}"
    if not (issubclass(own, CheckedParameters) and is_dataclass(own)):
        raise MethodError(f"{where} must be a dataclass derived from CheckedParameters.")
    if not own.__dataclass_params__.frozen:  # pyright: ignore[reportAttributeAccessIssue]
        raise MethodError(f"{where} must be frozen: @dataclass(frozen=True).")
    if any(m.parameters is own and m.name != method.name for m in _METHODS.values()):
        raise MethodError(f"{where} are another method's; derive a class of its own.")
    try:
        infos = infos_of(own)
        own()
    except (TypeError, ParameterError) as error:
        raise MethodError(f"{where} cannot be used: {error}") from error
    if sliding := [name for name, info in infos.items() if info.slider and info.optional]:
        raise MethodError(f"{where}: {sliding[0]} may be unset, and so has no slider.")


def find_method(name: str) -> Method:
    """The method registered under `name`; KeyError where there is none."""
    return _METHODS[name]


def all_methods() -> tuple[Method, ...]:
    """All registered methods, the paper's first."""
    return tuple(_METHODS.values())
