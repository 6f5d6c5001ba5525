"""Parameters in files and on the command line."""

import json
import reprlib
from pathlib import Path
from typing import Annotated

from pydantic import ConfigDict, Field, TypeAdapter, ValidationError

from app.analysis.json_text import LARGEST, check_size, from_json, kind_of
from app.errors import InputError
from estimator import ParameterError, Parameters, from_nested, to_nested
from robot_assets.input_files import open_file

_Name = Annotated[str, Field(max_length=100)]
_Value = bool | int | float | Annotated[str, Field(max_length=1000)] | None
_SHAPE = TypeAdapter(dict[_Name, _Value | dict[_Name, _Value]], config=ConfigDict(strict=True))
"""Any parameters of any method; which there are, and what they may be, the estimator knows."""


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
        InputError: it is not JSON as `from_json` takes it, names a parameter that there is not, or
            has a wrong value.
    """
    content = from_json(text, where)
    if isinstance(content, dict) and "parameters" in content:
        content = content["parameters"]
    if not isinstance(content, dict):
        raise InputError(
            f'{where} must hold parameters, such as {{"n": 8, "gamma": 0.7}}, and not '
            f"{kind_of(content)}."
        )
    try:
        _SHAPE.validate_python(content)
    except ValidationError as error:
        first = error.errors(include_url=False)[0]
        if first["loc"][-1] == "[key]":
            said = f"{reprlib.repr(first['input'])} is longer than the name of any parameter"
        else:
            key = str(first["loc"][0])
            said = (
                f"{key} must be a number, a text, true, false or null, or a table of such, got "
                f"{reprlib.repr(content[key])}"
            )
        raise InputError(f"{where}: {said}.") from error
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
        with open_file(path) as file:
            content = file.read(LARGEST + 1)
        check_size(len(content), str(path))
        text = content.decode("utf-8-sig")
    except FileNotFoundError as error:
        raise InputError(f"There is no file {path}; check the spelling.") from error
    except OSError as error:
        raise InputError(f"{path} cannot be read as parameters ({error.strerror}).") from error
    except UnicodeDecodeError as error:
        raise InputError(f"{path} is not a text file, so it cannot be a parameter file.") from error
    return from_text(text, str(path))
