"""The estimator's parameters as flags of the command line, one flag per field."""

import argparse
from collections.abc import Collection
from dataclasses import fields, replace
from pathlib import Path

from app.analysis.parameter_files import load
from estimator import PARAMETER_INFO, ParameterInfo, Parameters, method_names


def add_parameter_flags(parser: argparse.ArgumentParser, leave_out: Collection[str] = ()) -> None:
    """Add --parameters FILE, and a flag for every field of `Parameters`, named like the field.

    Args:
        parser: of a subcommand.
        leave_out: fields that the subcommand has a flag of its own for.
    """
    group = parser.add_argument_group("parameters of the estimator")
    group.add_argument(
        "--parameters",
        type=Path,
        metavar="FILE",
        help="parameters as the app saves them (JSON); flags beside it win",
    )
    for field in fields(Parameters):
        if field.name in leave_out:
            continue
        flag, info = "--" + field.name.replace("_", "-"), PARAMETER_INFO[field.name]
        text = _help(info, field.default)
        # Only flags that are given are set, so that they can win over a file.
        if field.name == "method":
            group.add_argument(flag, choices=method_names(), default=argparse.SUPPRESS, help=text)
        elif isinstance(field.default, bool):
            group.add_argument(
                flag, action=argparse.BooleanOptionalAction, default=argparse.SUPPRESS, help=text
            )
        else:
            kind = float if isinstance(field.default, float) else int
            name = info.unit.upper() or "VALUE"
            group.add_argument(flag, type=kind, metavar=name, default=argparse.SUPPRESS, help=text)


def parameters_from(options: argparse.Namespace) -> Parameters:
    """Collect file and flags.

    Raises:
        ParameterError: a flag is out of range.
        InputError: the file cannot be used.
    """
    parameters = load(options.parameters) if options.parameters else Parameters()
    given = {f.name: getattr(options, f.name) for f in fields(Parameters) if f.name in options}
    return replace(parameters, **given)


def _help(info: ParameterInfo, default: object) -> str:
    symbol = f"{info.symbol}: " if info.symbol else ""
    unit = f" {info.unit}" if info.unit and default is not None else ""
    shown = "unset" if default is None else default
    return f"{symbol}{info.text} (default {shown}{unit})".replace("%", "%%")
