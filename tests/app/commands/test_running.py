"""Only the subcommand that is asked for is imported, and help imports nothing large."""

import subprocess
import sys
from importlib import import_module

import pytest

from app.command_line import main
from app.commands.running import SUBCOMMANDS
from tests.conftest import REPOSITORY

_LARGE = {"matplotlib", "numba", "open3d", "rosbags", "scipy", "sklearn", "trimesh", "viser"}
_IMPORTED = """
import sys
from app.command_line import main
try:
    main(sys.argv[1:])
except SystemExit:
    print(*sorted(sys.modules), sep="\\n", file=sys.stderr)
"""


def imported_by(*arguments: str) -> set[str]:
    """Names of the modules that a command line of `tofscope` has imported at its end."""
    done = subprocess.run(
        [sys.executable, "-c", _IMPORTED, *arguments],
        cwd=REPOSITORY,
        capture_output=True,
        text=True,
        check=True,
    )
    assert "usage: tofscope" in done.stdout
    return set(done.stderr.split())


def test_the_help_needs_python_alone():
    assert not imported_by("--help") & {"numpy", "pydantic", "rich", *_LARGE}


@pytest.mark.parametrize("name", SUBCOMMANDS)
def test_the_help_of_a_subcommand_imports_it_alone_and_nothing_large(name):
    imported = imported_by(name, "--help")
    commands = {f"app.commands.{other}" for other in SUBCOMMANDS}
    assert imported & commands == {f"app.commands.{name}"}
    assert not imported & _LARGE


def test_the_help_lists_every_subcommand_with_its_sentence(capsys):
    with pytest.raises(SystemExit) as ended:
        main(["--help"])
    assert ended.value.code == 0
    said = " ".join(capsys.readouterr().out.split())
    for name, sentence in SUBCOMMANDS.items():
        assert f"{name} {sentence}" in said


@pytest.mark.parametrize("name", SUBCOMMANDS)
def test_every_listed_subcommand_has_a_module(name):
    module = import_module(f"app.commands.{name}")
    assert callable(module.add_flags)
    assert callable(module.run)


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        ([], "the following arguments are required: COMMAND"),
        (["look"], "invalid choice: 'look'"),
        (["look", "view"], "invalid choice: 'look'"),
        (["--log-level", "info"], "the following arguments are required"),
    ],
)
def test_a_wrong_subcommand_is_one_sentence(arguments, said, capsys):
    with pytest.raises(SystemExit) as ended:
        main(arguments)
    assert ended.value.code == 2
    lines = capsys.readouterr().err.splitlines()
    assert len(lines) == 1
    assert said in lines[0]
