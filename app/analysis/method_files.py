"""Methods loaded from a user's own files, named FILE.py:NAME on the command line."""

import hashlib
import importlib.util
import re
import sys
from collections.abc import Callable, Iterable
from pathlib import Path
from types import ModuleType
from typing import Any

from app.errors import InputError
from estimator import Method, MethodError, register

_SEPARATOR = ".py:"
_loaded: dict[str, Method] = {}


def is_method_file(text: str) -> bool:
    """Whether a text has the form FILE.py:NAME, unlike names of registered methods."""
    return _SEPARATOR in text


def load_method(text: str) -> str:
    """Load and register the method FILE.py:NAME, and return its registered name.

    NAME is a `Method`, or a function (window, parameters) -> SceneFlow, registered as FILE-NAME.
    The file is executed, so the text must come from the command line, never from a browser.

    Raises:
        InputError: the file or the name in it does not exist, or it cannot be registered.
    """
    path, name = split_method_file(text)
    key = f"{path}:{name}"
    if key not in _loaded:
        found = getattr(_module(path), name, None)
        method = found if isinstance(found, Method) else _of_function(path, name, found)
        try:
            register(method)
        except MethodError as error:
            raise InputError(f"{text}: {error}") from error
        _loaded[key] = method
    return _loaded[key].name


def method_files(names: Iterable[str]) -> tuple[str, ...]:
    """FILE.py:NAME, with absolute paths, of those methods in `names` that came from files."""
    wanted = set(names)
    return tuple(text for text, method in _loaded.items() if method.name in wanted)


def split_method_file(text: str) -> tuple[Path, str]:
    """Absolute path of the file, and the name in it, of FILE.py:NAME.

    Raises:
        InputError: there is no such file.
    """
    file, _, name = text.rpartition(":")
    path = Path(file).resolve()
    if not path.is_file():
        raise InputError(f"There is no file {file} for the method {text}; check the spelling.")
    return path, name


def content_digest(texts: Iterable[str]) -> str:
    """SHA-256 of the contents of these method files, "" for none."""
    contents = [split_method_file(text)[0].read_bytes() for text in texts]
    return hashlib.sha256(b"\0".join(contents)).hexdigest() if contents else ""


def _module(path: Path) -> ModuleType:
    # Equal in every process, so that pickled objects of its classes reach workers.
    name = f"tofscope_method_{hashlib.sha256(str(path).encode()).hexdigest()[:16]}"
    if name in sys.modules:
        return sys.modules[name]
    spec = importlib.util.spec_from_file_location(name, path)
    assert spec is not None
    assert spec.loader is not None  # its name ends in .py
    module = importlib.util.module_from_spec(spec)
    sys.modules[name] = module
    try:
        spec.loader.exec_module(module)
    except (Exception, SystemExit) as error:
        del sys.modules[name]
        raise InputError(f"{path} cannot be run: {type(error).__name__}: {error}.") from error
    return module


def _of_function(path: Path, name: str, found: Any) -> Method:  # noqa: ANN401 (anything in a file)
    if not callable(found):
        raise InputError(
            f"{path} has no method {name}; it must be a Method, or a function "
            "(window, parameters) -> SceneFlow."
        )
    flow: Callable[..., Any] = found
    plain = re.sub(r"[^A-Za-z0-9_-]+", "-", f"{path.stem}-{name}")
    return Method(plain, flow, title=f"{path.name}:{name}")
