"""What is imported is declared, and what is declared has a version."""

import ast
import re
import sys
import tomllib
from importlib.metadata import packages_distributions
from pathlib import Path

from tests.conftest import REPOSITORY
from tests.test_rooms import TOP, imported_names

PROJECT = tomllib.loads((REPOSITORY / "pyproject.toml").read_text("utf-8"))["project"]
EXTRAS = PROJECT["optional-dependencies"]
LOADED_BY_OTHERS = {
    "embreex",  # trimesh casts rays with it
    "example-robot-data",  # files alone
    "open3d",  # open3d-cpu under another name, for other machines
}
TOOLS = {"pre-commit", "pyright", "ruff"}


def normal(name: str) -> str:
    return re.sub(r"[-_.]+", "-", name).lower()


def declared(lines: list[str]) -> set[str]:
    """Names of packages in requirements."""
    return {normal(re.split(r"[^A-Za-z0-9._-]", line)[0]) for line in lines}


def imported(*folders: str) -> dict[str, Path]:
    """{package: a file that imports it} of packages that are not the project's own."""
    distributions, found = packages_distributions(), {}
    for folder in folders:
        for path in (REPOSITORY / folder).rglob("*.py"):
            for name in imported_names(ast.parse(path.read_text("utf-8"))):
                top = name.partition(".")[0]
                if top in sys.stdlib_module_names or top in (*TOP, "tests", "benchmarks"):
                    continue
                for package in distributions.get(top, [top]):
                    found[normal(package)] = path
    return found


RUNTIME = declared(PROJECT["dependencies"])


def test_what_tofscope_imports_is_declared_and_nothing_else_is():
    found = imported(*TOP)
    assert len(found) > 15
    wanted = RUNTIME | declared(EXTRAS["dask"]) | declared(EXTRAS["video"])
    assert {name: str(path) for name, path in found.items() if name not in wanted} == {}
    assert wanted - found.keys() - LOADED_BY_OTHERS - {"open3d-cpu"} == set()


def test_what_tests_and_benchmarks_import_is_declared():
    found, wanted = imported("tests", "benchmarks"), RUNTIME | declared(EXTRAS["dev"])
    assert {name: str(path) for name, path in found.items() if name not in wanted} == {}
    optional = declared(EXTRAS["dask"]) | declared(EXTRAS["video"])
    assert declared(EXTRAS["dev"]) - found.keys() - TOOLS <= optional


def test_every_package_has_a_version_and_the_constraints_hold_nothing_else():
    lines = (REPOSITORY / "constraints.txt").read_text("utf-8").splitlines()
    pinned = [line for line in lines if line and not line.startswith("#")]
    assert [line for line in pinned if not re.fullmatch(r"[\w.-]+==[\w.]+", line)] == []
    everything = RUNTIME | declared([line for extra in EXTRAS.values() for line in extra])
    assert everything - declared(pinned) == set()
