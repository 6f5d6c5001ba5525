"""The estimator's parameters as flags of the command line, one flag per parameter."""

import argparse
from collections.abc import Callable, Collection, Sequence
from contextlib import suppress
from pathlib import Path

from app.analysis.method_files import is_method_file, load_method
from app.analysis.parameter_files import flag_of, load
from app.errors import InputError
from estimator import (
    PARAMETER_INFO,
    MethodError,
    ParameterInfo,
    Parameters,
    all_methods,
    changed,
    method_names,
)

_METHOD_FLAG = "--method"


def register_method_files(arguments: Sequence[str]) -> None:
    """Register the methods given as --method FILE.py:NAME, so that their parameters become flags.

    Files that cannot be used are ignored here; parsing --method reports them.
    """
    after_flag = False
    for argument in arguments:
        if argument.startswith("-"):
            flag, _, value = argument.partition("=")
            after_flag = flag == _METHOD_FLAG
        else:
            value = argument
        if after_flag and is_method_file(value):
            with suppress(InputError):
                load_method(value)


def method_name(text: str) -> str:
    """Name of the registered method that --method gives by its name or as FILE.py:NAME.

    Raises:
        ArgumentTypeError: the file cannot be used.
    """
    if not is_method_file(text):
        return text
    try:
        return load_method(text)
    except InputError as error:
        raise argparse.ArgumentTypeError(str(error).rstrip(".")) from error


def add_parameter_flags(parser: argparse.ArgumentParser, leave_out: Collection[str] = ()) -> None:
    """Add --parameters FILE, and a flag for every parameter, named like it.

    Flags of a method's own parameters begin with the method's name.

    Args:
        parser: of a subcommand.
        leave_out: parameters for which the subcommand defines its own flag.
    """
    group = parser.add_argument_group("parameters of the estimator")
    group.add_argument(
        "--parameters",
        type=Path,
        metavar="FILE",
        help="parameters as the app saves them (JSON); other flags take precedence",
    )
    for name, info in PARAMETER_INFO.items():
        if name == "method" and name not in leave_out:
            group.add_argument(
                _METHOD_FLAG,
                type=method_name,
                choices=method_names(),
                default=argparse.SUPPRESS,
                help=f"{_help(info)}; a method of your own: FILE.py:NAME",
            )
        elif name not in leave_out:
            _add_flag(group, name, info)
    for method in all_methods():
        own = {name: info for name, info in method.infos().items() if name not in PARAMETER_INFO}
        group = parser.add_argument_group(f"parameters of {method.name}") if own else group
        for name, info in own.items():
            try:
                _add_flag(group, name, info)
            except argparse.ArgumentError as error:
                raise MethodError(
                    f"Method {method.name} cannot have the flag {flag_of(name)}, which is already "
                    "in use; rename the method or its parameter."
                ) from error


def parameters_from(options: argparse.Namespace) -> Parameters:
    """Parameters from --parameters and from the flags, which take precedence.

    Raises:
        ParameterError: a flag is out of range.
        InputError: the file cannot be used.
    """
    parameters = load(options.parameters) if options.parameters else Parameters()
    names = [*PARAMETER_INFO, *(name for method in all_methods() for name in method.infos())]
    return changed(parameters, {n: getattr(options, n) for n in names if n in options})


def _add_flag(group: argparse._ArgumentGroup, name: str, info: ParameterInfo) -> None:
    # Only given flags are set: defaults must not override the file.
    flag, text, unset = flag_of(name), _help(info), argparse.SUPPRESS
    if info.kind is bool:
        action = argparse.BooleanOptionalAction
        group.add_argument(flag, dest=name, action=action, default=unset, help=text)
    elif info.choices:
        group.add_argument(flag, dest=name, choices=info.choices, default=unset, help=text)
    else:
        unit, read = info.unit.upper() or "VALUE", _reader(info)
        group.add_argument(flag, dest=name, type=read, metavar=unit, default=unset, help=text)


def _reader(info: ParameterInfo) -> Callable[[str], object]:
    """Function from a flag's text to a value of the parameter's type."""

    def read(text: str) -> object:
        try:
            return info.kind(text)
        except ValueError:
            raise argparse.ArgumentTypeError(f"must be {info.kind_text}, got {text!r}") from None

    return read


def _help(info: ParameterInfo) -> str:
    symbol = f"{info.symbol}: " if info.symbol else ""
    unit = f" {info.unit}" if info.unit and info.default is not None else ""
    shown = "unset" if info.default is None else info.default
    return f"{symbol}{info.text} (default {shown}{unit})".replace("%", "%%")
