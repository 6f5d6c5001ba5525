"""Benchmarks name the app's commands as the app does."""

import re

from tests.conftest import REPOSITORY


def test_every_command_that_a_benchmark_triggers_is_the_apps():
    panels = "".join(path.read_text() for path in (REPOSITORY / "app" / "panels").glob("*.py"))
    triggered = [
        label
        for path in (REPOSITORY / "benchmarks").rglob("*.py")
        for label in re.findall(r'trigger\("([^"]+)"\)', path.read_text())
    ]
    assert triggered
    assert [label for label in triggered if f'"{label}"' not in panels] == []
