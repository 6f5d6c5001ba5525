"""Compilation of the engine's functions by numba."""

import hashlib
import os
from collections.abc import Callable
from functools import cache
from pathlib import Path
from typing import Any, TypeVar, cast

import numba
import platformdirs
from numba.core import config

_Function = TypeVar("_Function", bound=Callable[..., object])
_NUMBA: Any = config  # its settings are made at run time


def compiled(function: _Function) -> _Function:
    """Compile a function at its first call, without the GIL, and keep the code between runs.

    Arithmetic is IEEE's in the order written: no fast math, and x / 0 is inf or NaN.
    """
    options = {"nogil": True, "error_model": "numpy"}
    folder = cache_folder()
    if folder is None:
        return cast(_Function, numba.njit(function, **options))
    given, _NUMBA.CACHE_DIR = _NUMBA.CACHE_DIR, str(folder)
    try:
        return cast(_Function, numba.njit(function, cache=True, **options))
    finally:
        _NUMBA.CACHE_DIR = given


@cache
def cache_folder() -> Path | None:
    """Folder of the compiled code; None where none can be written, and nothing is kept.

    In NUMBA_CACHE_DIR where that is set, else among the user's caches. It is of this version of
    the engine alone: numba looks for changes in a function's own file, not in those that it calls.
    """
    given = os.environ.get("NUMBA_CACHE_DIR")
    root = Path(given) if given else platformdirs.user_cache_path("tofscope")
    folder = root / f"engine-{_digest()}"
    try:
        folder.mkdir(parents=True, exist_ok=True)
        probe = folder / f"probe-{os.getpid()}"
        probe.touch()
        probe.unlink()
    except OSError:
        return None
    return folder


def _digest() -> str:
    digest = hashlib.sha256()
    for path in sorted(Path(__file__).parent.glob("*.py")):
        digest.update(path.name.encode() + b"\0" + path.read_bytes())
    return digest.hexdigest()[:16]
