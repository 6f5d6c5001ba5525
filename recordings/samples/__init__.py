"""The recordings that come with Tofscope; all of them are simulated."""

from pathlib import Path


def sample_paths() -> list[Path]:
    """The shipped sample recordings, by name."""
    return sorted(Path(__file__).parent.glob("*.mcap"))
