"""The estimator's parameters as flags of the command line, one flag per field."""

import argparse
from dataclasses import fields

from estimator import PARAMETER_INFO, ParameterInfo, Parameters, method_names


def add_parameter_flags(parser: argparse.ArgumentParser) -> None:
    """Add a flag for every field of `Parameters`, named like the field."""
    group = parser.add_argument_group("parameters of the estimator")
    for field in fields(Parameters):
        flag, info = "--" + field.name.replace("_", "-"), PARAMETER_INFO[field.name]
        text = _help(info, field.default)
        if field.name == "method":
            group.add_argument(flag, choices=method_names(), default=field.default, help=text)
        elif isinstance(field.default, bool):
            group.add_argument(
                flag, action=argparse.BooleanOptionalAction, default=field.default, help=text
            )
        else:
            kind = float if isinstance(field.default, float) else int
            name = info.unit.upper() or "VALUE"
            group.add_argument(flag, type=kind, default=field.default, metavar=name, help=text)


def parameters_from(options: argparse.Namespace) -> Parameters:
    """Collect the flags into `Parameters`; ParameterError where one is out of range."""
    return Parameters(**{field.name: getattr(options, field.name) for field in fields(Parameters)})


def _help(info: ParameterInfo, default: object) -> str:
    symbol = f"{info.symbol}: " if info.symbol else ""
    unit = f" {info.unit}" if info.unit and default is not None else ""
    shown = "unset" if default is None else default
    return f"{symbol}{info.text} (default {shown}{unit})".replace("%", "%%")
