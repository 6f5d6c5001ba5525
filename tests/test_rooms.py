"""The rule of the house: data walks through four rooms in one direction."""

import ast
from collections.abc import Iterator
from pathlib import Path

import pytest

REPOSITORY = Path(__file__).resolve().parent.parent
ROOMS = {"robot_assets", "recordings", "estimator", "app"}
MAY_IMPORT = {
    "robot_assets": {"robot_assets"},
    "recordings": {"recordings", "robot_assets"},
    "estimator": {"estimator"},
    "app": ROOMS,
}
ESTIMATOR_KNOWS_NOTHING_OF = {"argparse", "mcap", "pathlib", "rosbags", "viser"}
ONLY_APP_SHOWS = {"viser"}


def imported_packages(module: ast.AST) -> Iterator[str]:
    """The top-level packages that a module imports anywhere, also by name."""
    for node in ast.walk(module):
        if isinstance(node, ast.Import):
            yield from (alias.name.partition(".")[0] for alias in node.names)
        elif isinstance(node, ast.ImportFrom):
            assert node.level == 0, "imports are absolute, so that this test can read them"
            yield str(node.module).partition(".")[0]
        elif isinstance(node, ast.Call) and _is_import_call(node.func):
            for argument in node.args[:1]:
                if isinstance(argument, ast.Constant) and isinstance(argument.value, str):
                    yield argument.value.partition(".")[0]


def _is_import_call(function: ast.expr) -> bool:
    return ast.unparse(function) in {"import_module", "importlib.import_module", "__import__"}


def packages_of(room: str) -> dict[Path, set[str]]:
    modules = sorted((REPOSITORY / room).rglob("*.py"))
    assert modules, f"{room} holds no modules"
    return {path: set(imported_packages(ast.parse(path.read_text("utf-8")))) for path in modules}


@pytest.mark.parametrize("room", sorted(ROOMS))
def test_a_room_imports_only_the_rooms_before_it(room):
    for path, packages in packages_of(room).items():
        wrong = (packages & ROOMS) - MAY_IMPORT[room]
        assert not wrong, f"{path.relative_to(REPOSITORY)} imports {', '.join(sorted(wrong))}"


def test_the_estimator_knows_no_file_no_viewer_and_no_command_line():
    for path, packages in packages_of("estimator").items():
        wrong = packages & ESTIMATOR_KNOWS_NOTHING_OF
        assert not wrong, f"{path.relative_to(REPOSITORY)} imports {', '.join(sorted(wrong))}"


@pytest.mark.parametrize("room", sorted(ROOMS - {"app"}))
def test_only_the_app_imports_the_viewer(room):
    for path, packages in packages_of(room).items():
        assert not packages & ONLY_APP_SHOWS, f"{path.relative_to(REPOSITORY)} imports viser"


@pytest.mark.parametrize(
    "line",
    [
        "import app.memory",
        "from app import memory",
        "from app.memory import Memory",
        "def f():\n    import app",
        "import_module('app.memory')",
        "importlib.import_module('app')",
    ],
)
def test_every_way_to_import_is_seen(line):
    assert "app" in set(imported_packages(ast.parse(line)))
