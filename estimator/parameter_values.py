"""Parameters as plain values: by name for controls and flags, nested for files."""

from collections.abc import Mapping
from dataclasses import replace
from typing import Any

from estimator.method import all_methods
from estimator.parameter_info import CheckedParameters, ParameterError, infos_of
from estimator.parameters import PARAMETER_INFO, Parameters


def values_of(parameters: Parameters) -> dict[str, Any]:
    """{name: value} of all parameters; a method's own are named such as `rays.sigma`."""
    found = {name: getattr(parameters, name) for name in PARAMETER_INFO}
    for method, own_class in _own_classes().items():
        own = parameters.of(own_class)
        found |= {f"{method}.{name}": getattr(own, name) for name in infos_of(own_class)}
    return found


def changed(parameters: Parameters, values: Mapping[str, Any]) -> Parameters:
    """Parameters with some values replaced, {name as in `values_of`: value}.

    Raises:
        ParameterError: there is no such parameter, or its value cannot be taken.
    """
    shared: dict[str, Any] = {}
    own: dict[str, dict[str, Any]] = {}
    for name, value in values.items():
        method, _, own_name = name.rpartition(".")
        if method:
            own.setdefault(method, {})[own_name] = value
        else:
            shared[name] = value
    if unknown := set(shared) - set(PARAMETER_INFO):
        raise ParameterError(
            f"{min(unknown)} is no parameter; parameters are {', '.join(PARAMETER_INFO)}."
        )
    changed_own = [_changed_own(parameters, method, changes) for method, changes in own.items()]
    kept = [each for each in parameters.own if type(each) not in {type(c) for c in changed_own}]
    return replace(parameters, **shared, own=(*kept, *changed_own))


def to_nested(parameters: Parameters) -> dict[str, Any]:
    """Parameters as nested JSON: a method's own are in a table of its name.

    Tables of methods other than the selected one are left out where they hold only defaults.
    """
    found: dict[str, Any] = {name: getattr(parameters, name) for name in PARAMETER_INFO}
    for method, own_class in _own_classes().items():
        own = parameters.of(own_class)
        if method == parameters.method or own != own_class():
            found[method] = {name: getattr(own, name) for name in infos_of(own_class)}
    return found


def from_nested(content: Mapping[str, Any]) -> Parameters:
    """Parameters from the result of `to_nested`; missing ones have their defaults.

    Raises:
        ParameterError: a parameter is not known, or its value cannot be taken.
    """
    values: dict[str, Any] = {}
    own_classes = _own_classes()
    for name, value in content.items():
        if name in own_classes and isinstance(value, Mapping):
            values |= {f"{name}.{own_name}": own_value for own_name, own_value in value.items()}
        else:
            values[name] = value
    return changed(Parameters(), values)


def _own_classes() -> dict[str, type[CheckedParameters]]:
    return {m.name: m.parameters for m in all_methods() if m.parameters is not None}


def _changed_own(
    parameters: Parameters, method: str, values: Mapping[str, Any]
) -> CheckedParameters:
    own_class = _own_classes().get(method)
    if own_class is None:
        raise ParameterError(f"{method}.{min(values)} is no parameter; {method} has none.")
    known = infos_of(own_class)
    if unknown := set(values) - set(known):
        raise ParameterError(
            f"{method}.{min(unknown)} is no parameter; those of {method} are {', '.join(known)}."
        )
    try:
        own: CheckedParameters = replace(parameters.of(own_class), **values)  # pyright: ignore[reportArgumentType]
    except ParameterError as error:
        raise ParameterError(f"{method}.{error}") from None
    return own
