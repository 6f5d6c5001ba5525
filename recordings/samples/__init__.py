"""Sample recordings that come with Tofscope; all of them are simulated."""

from pathlib import Path


def sample_paths() -> list[Path]:
    """Paths of the sample recordings, sorted by name."""
    return sorted(Path(__file__).parent.glob("*.mcap"))
