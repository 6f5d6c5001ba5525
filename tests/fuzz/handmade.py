"""Hostile recordings made by hand, each of what its name says."""

from collections.abc import Callable
from pathlib import Path

HANDMADE: dict[str, Callable[[Path], Path]] = {}
