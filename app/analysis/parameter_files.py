"""Parameters in files and on the command line."""

import json
from pathlib import Path
from typing import Any

from app.errors import InputError
from estimator import ParameterError, Parameters, from_nested, to_nested


def flag_of(name: str) -> str:
    """The command line's flag of a parameter: --n-min of n_min, --rays-sigma of rays.sigma."""
    return "--" + name.replace("_", "-").replace(".", "-")


def to_text(parameters: Parameters) -> str:
    """Parameters as JSON, a line each."""
    return json.dumps(to_nested(parameters), indent=2) + "\n"


def from_text(text: str, where: str) -> Parameters:
    """Parameters from JSON as `to_text` makes it, or from a table of `tofscope evaluate`.

    Parameters that are not named keep their defaults.

    Args:
        text: JSON.
        where: a file's name, for the sentence.

    Raises:
        InputError: it is not JSON, names a parameter that there is not, or has a wrong value.
    """
    try:
        content: Any = json.loads(text)
    except ValueError as error:
        raise InputError(f"{where} is not JSON: {error}.") from error
    if isinstance(content, dict) and isinstance(content.get("parameters"), dict):
        content = content["parameters"]
    if not isinstance(content, dict):
        raise InputError(f'{where} must hold parameters, such as {{"n": 8, "gamma": 0.7}}.')
    try:
        return from_nested(content)
    except ParameterError as error:
        raise InputError(f"{where}: {error}") from error


def load(path: Path) -> Parameters:
    """Parameters from a file.

    Raises:
        InputError: the file cannot be read, or `from_text` says what is wrong with it.
    """
    try:
        text = path.read_text(encoding="utf-8")
    except FileNotFoundError as error:
        raise InputError(f"There is no file {path}; check the spelling.") from error
    except OSError as error:
        raise InputError(f"{path} cannot be read as parameters ({error.strerror}).") from error
    except UnicodeDecodeError as error:
        raise InputError(f"{path} is no text, and so no file of parameters.") from error
    return from_text(text, str(path))
