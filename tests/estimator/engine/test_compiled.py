"""The compiling decorator, and the folder that it keeps its code in."""

import os
import subprocess
import sys

from estimator.engine import compiled as module
from estimator.engine.compiled import cache_folder, compiled


@compiled
def divided(a: float, b: float) -> float:
    """A quotient."""
    return a / b


def test_arithmetic_is_the_processors():
    assert divided(1.0, 3.0) == 1.0 / 3.0
    assert divided(1.0, 0.0) == float("inf")


def test_the_folder_is_of_this_version_of_the_engine(monkeypatch, tmp_path):
    monkeypatch.setenv("NUMBA_CACHE_DIR", str(tmp_path))
    monkeypatch.setattr(module, "_digest", lambda: "one")
    first = cache_folder.__wrapped__()
    monkeypatch.setattr(module, "_digest", lambda: "two")
    second = cache_folder.__wrapped__()
    assert first is not None
    assert first == tmp_path / "engine-one"
    assert second == tmp_path / "engine-two"
    assert first.is_dir()
    assert list(first.iterdir()) == []


def test_where_no_folder_can_be_made_it_compiles_all_the_same(tmp_path):
    (tmp_path / "file").touch()
    code = (
        "from estimator.engine.compiled import cache_folder, compiled\n"
        "assert cache_folder() is None\n"
        "assert compiled(lambda a: a + 1.0)(1.0) == 2.0"
    )
    nowhere = {"NUMBA_CACHE_DIR": str(tmp_path / "file")}  # a file, where a folder is needed
    done = subprocess.run([sys.executable, "-c", code], env=os.environ | nowhere, check=False)
    assert done.returncode == 0
