"""The structure of the project: which room may import which, and no circle anywhere."""

import ast
from collections.abc import Iterator
from graphlib import CycleError, TopologicalSorter
from pathlib import Path

import pytest

REPOSITORY = Path(__file__).resolve().parent.parent
TOP = ("robot_assets", "recordings", "estimator", "app")
LOWER = {"robot_assets", "recordings", "estimator"}
ERRORS = "app.errors"
"""The one module of `app` beside its rooms: every room may name the errors made for people."""
SHOWN = {"app.browser", "app.scene", "app.analysis"}
MAY_IMPORT: dict[str, set[str]] = {
    "robot_assets": set(),
    "recordings": {"robot_assets"},
    "estimator": set(),
    ERRORS: LOWER,
    "app.browser": set(),
    "app.output": set(),
    "app.terminal": {"robot_assets"},
    "app.analysis": LOWER,
    "app.execution": {"app.analysis", "estimator"},
    "app.study": {"app.analysis", "app.execution", "app.output", "app.terminal", *LOWER},
    "app.scene": {"app.browser", "app.analysis", "app.output", *LOWER},
    "app.session": {"app.scene", "app.analysis", "app.output", *LOWER},
    "app.exports": {"app.output", *SHOWN, *LOWER},
    "app.panels": {"app.session", "app.exports", "app.output", *SHOWN, *LOWER},
    "app.server": {"app.panels", "app.session", *SHOWN, *LOWER},
    "app.commands": {
        *("app.server", "app.panels", "app.session", "app.exports", "app.study"),
        *("app.execution", "app.output", "app.terminal"),
        *SHOWN,
        *LOWER,
    },
    "app.command_line": {"app.commands"},
    "app.__main__": {"app.command_line"},
}
"""{room: the rooms that it may import beside itself}; the design, as a table."""
NOT_IN_THE_CORE = {"argparse", "mcap", "pathlib", "rosbags", "viser"}
KEEPS_MACHINE_CODE = {"estimator.engine.compiled", "estimator.engine.readiness"}
"""Modules of the core that know where compiled code is kept, and so a folder."""


def modules() -> dict[str, Path]:
    """{dotted name: file} of every module of the project; a package is its `__init__`."""
    found: dict[str, Path] = {}
    for top in TOP:
        for path in sorted((REPOSITORY / top).rglob("*.py")):
            name = ".".join(path.relative_to(REPOSITORY).with_suffix("").parts)
            found[name.removesuffix(".__init__")] = path
    assert len(found) > 100
    return found


MODULES = modules()


def room_of(module: str) -> str:
    """The room that a module belongs to: a top-level package, or a package of `app`."""
    if not module.startswith("app."):
        return module.partition(".")[0]
    return ".".join(module.split(".")[:2])


def imported_names(tree: ast.AST) -> Iterator[str]:
    """Every name that is imported anywhere, under TYPE_CHECKING, in functions and by string too."""
    for node in ast.walk(tree):
        if isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names)
        elif isinstance(node, ast.ImportFrom):
            assert node.level == 0, "imports are absolute, so that this test can read them"
            yield from (f"{node.module}.{alias.name}" for alias in node.names)
        elif isinstance(node, ast.Call) and _is_import_call(node.func):
            for argument in node.args[:1]:
                if isinstance(argument, ast.Constant) and isinstance(argument.value, str):
                    yield argument.value


def _is_import_call(function: ast.expr) -> bool:
    return ast.unparse(function) in {"import_module", "importlib.import_module", "__import__"}


def imported_modules(tree: ast.AST) -> set[str]:
    """The project's modules behind the imported names."""
    found: set[str] = set()
    for name in imported_names(tree):
        module = name
        while module and module not in MODULES:
            module = module.rpartition(".")[0]
        if module:
            found.add(module)
    return found


IMPORTS = {
    name: imported_modules(ast.parse(path.read_text("utf-8"))) - {name}
    for name, path in MODULES.items()
}


@pytest.mark.parametrize("room", sorted({room_of(name) for name in MODULES} - {"app"}))
def test_a_room_imports_only_what_stands_below_it(room):
    assert room in MAY_IMPORT, f"{room} has no place in the design"
    allowed = {room, *MAY_IMPORT[room], *({ERRORS} if room.startswith("app.") else ())}
    wrong = {
        f"{name} imports {target}"
        for name, targets in IMPORTS.items()
        if room_of(name) == room
        for target in targets
        if room_of(target) not in allowed
    }
    if room == "app.browser":
        wrong |= {f"{n} imports {ERRORS}" for n in MODULES if ERRORS in IMPORTS[n] and room in n}
    assert not wrong, "\n".join(sorted(wrong))


def test_the_rooms_have_no_circle():
    order = list(TopologicalSorter(MAY_IMPORT).static_order())  # raises where there is one
    assert set(order) >= MAY_IMPORT.keys()


def test_no_modules_import_each_other_in_a_circle():
    # A package imports its own modules, so a module that imports its package closes a circle.
    try:
        TopologicalSorter(IMPORTS).prepare()
    except CycleError as error:
        pytest.fail(" -> ".join(reversed(error.args[1])))


@pytest.mark.parametrize(
    "room", sorted(name for name in MAY_IMPORT if MODULES[name].stem == "__init__")
)
def test_a_room_says_in_one_sentence_what_it_is_for(room):
    said = ast.get_docstring(ast.parse(MODULES[room].read_text("utf-8"))) or ""
    assert said.split("\n")[0].endswith("."), f"{room} says {said!r}"


def test_the_estimator_knows_no_file_no_viewer_and_no_command_line():
    for name, path in MODULES.items():
        if room_of(name) == "estimator" and name not in KEEPS_MACHINE_CODE:
            tops = {n.partition(".")[0] for n in imported_names(ast.parse(path.read_text("utf-8")))}
            assert not tops & NOT_IN_THE_CORE, name


def test_only_the_app_imports_the_viewer():
    for name, path in MODULES.items():
        if room_of(name) in LOWER:
            names = imported_names(ast.parse(path.read_text("utf-8")))
            assert "viser" not in {n.partition(".")[0] for n in names}, name


def test_state_analysis_study_and_commands_import_no_viewer():
    # The workbench holds the client, to make the scene that it draws.
    importing = {
        name
        for name, path in MODULES.items()
        if room_of(name) in {"app.analysis", "app.session", "app.study", "app.commands"}
        and "viser"
        in {n.partition(".")[0] for n in imported_names(ast.parse(path.read_text("utf-8")))}
    }
    assert importing == {"app.session.workbench"}


@pytest.mark.parametrize(
    "line",
    [
        "import app.analysis.cache",
        "from app.analysis import cache",
        "from app.analysis.cache import Cache",
        "def f():\n    import app.analysis.cache",
        "if TYPE_CHECKING:\n    from app.analysis.cache import Cache",
        "import_module('app.analysis.cache')",
        "importlib.import_module('app.analysis.cache')",
    ],
)
def test_every_way_to_import_is_seen(line):
    assert imported_modules(ast.parse(line)) == {"app.analysis.cache"}
