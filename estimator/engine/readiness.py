"""Whether the compiled code is there, and how it comes to be there."""

import platform
from contextlib import suppress
from pathlib import Path

import llvmlite.binding
import numba

from estimator.engine.compiled import cache_folder
from estimator.engines import COMPILED, warm_up


def is_compiled() -> bool:
    """Whether all code was compiled on a processor of this kind before."""
    marker = _marker()
    with suppress(OSError):
        return marker is not None and marker.exists()
    return False


def compile_all() -> None:
    """Compile what is not there yet, in some 20 s, and load the rest, in half a second."""
    warm_up(COMPILED)
    if marker := _marker():
        with suppress(OSError):  # a full disk; it is compiled again next time
            marker.touch()


def _marker() -> Path | None:
    # numba compiles for one processor, Python and version of its own; a home may be shared.
    folder = cache_folder()
    made_for = (numba.__version__, platform.python_version(), llvmlite.binding.get_host_cpu_name())
    return folder / "-".join(("complete", *made_for)) if folder else None


if __name__ == "__main__":
    compile_all()
