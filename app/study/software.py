"""Version of the software that computes results: source digest and package versions."""

import hashlib
import platform
from functools import cache
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path

import estimator
import recordings
import robot_assets
from app.analysis.method_files import content_digest
from estimator import current_engine

OTHER_VERSION = (
    "the worker has another version of Tofscope or of a package that it computes with; give all "
    "workers the same"
)
"""Why a worker of a cluster is refused."""
_PACKAGES = (
    "numpy",
    "scipy",
    "scikit-learn",
    "open3d",
    "open3d-cpu",
    "numba",
    "llvmlite",
    "embreex",
    "trimesh",
    "yourdfpy",
    "example-robot-data",
    "rosbags",
    "mcap",
)


@cache
def versions() -> dict[str, str]:
    """{package: version} of everything that affects results, Python and Tofscope included."""
    found = {"tofscope": version("tofscope"), "python": platform.python_version()}
    for name in _PACKAGES:
        try:
            found[name] = version(name)
        except PackageNotFoundError:
            continue
    return found


_OF_APP = (
    *(f"analysis/{name}.py" for name in ("pairs", "pair_estimator", "evaluation")),
    *(f"study/{name}.py" for name in ("work", "diagnosis", "ranges")),
)
"""Files of `app` that affect results."""


def software_digest(method_files: tuple[str, ...] = ()) -> str:
    """SHA-256 of the source, of `versions`, of the engine's name, and of method files.

    Results computed under another digest are not reused.

    Args:
        method_files: FILE.py:NAME of each method from a file.
    """
    return _digest(method_files, current_engine().name)


@cache
def _digest(method_files: tuple[str, ...], engine: str) -> str:
    digest = hashlib.sha256(repr((engine, sorted(versions().items()))).encode())
    for room in (estimator, recordings, robot_assets):
        folder = Path(str(room.__file__)).parent
        for path in sorted([*folder.rglob("*.py"), *folder.rglob("*.toml")]):
            digest.update(str(path.relative_to(folder)).encode() + b"\0" + path.read_bytes())
    for name in _OF_APP:
        digest.update((Path(__file__).parent.parent / name).read_bytes())
    digest.update(content_digest(method_files).encode())
    return digest.hexdigest()
