"""Rig files made of the paper's, for tests."""

from importlib.resources import files
from pathlib import Path

from robot_assets import Rig, load_rig

PAPER = Path(str(files("robot_assets") / "rigs" / "paper.toml")).read_text("utf-8")
SINGLE = """
[[sensors]]
name = "wrist"
link = "panda_hand"
position_m = [0.05, 0.0, 0.03]
forward = [2.0, 0.0, 0.0]
up = [0.3, 0.0, 1.0]
"""
HEAD = PAPER.partition("# A ring:")[0]
RING = "[[rings]]" + PAPER.split("[[rings]]")[1]


def rig_of(tmp_path: Path, text: str) -> Rig:
    path = tmp_path / "my_rig.toml"
    path.write_text(text, encoding="utf-8")
    return load_rig(path)
