"""What decides a result beside its recording and parameters: our source, and the packages used."""

import hashlib
import platform
from functools import cache
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path

import app
import estimator
import recordings
import robot_assets

_PACKAGES = (
    "numpy",
    "scipy",
    "scikit-learn",
    "open3d",
    "open3d-cpu",
    "embreex",
    "trimesh",
    "yourdfpy",
    "example-robot-data",
    "rosbags",
    "mcap",
)


@cache
def versions() -> dict[str, str]:
    """{package: version} of all that takes part in computing, Python and Tofscope included."""
    found = {"tofscope": version("tofscope"), "python": platform.python_version()}
    for name in _PACKAGES:
        try:
            found[name] = version(name)
        except PackageNotFoundError:
            continue
    return found


@cache
def software_digest() -> str:
    """A digest of our source and of `versions`: results of another one are not these."""
    digest = hashlib.sha256(repr(sorted(versions().items())).encode())
    for room in (estimator, recordings, robot_assets):
        folder = Path(str(room.__file__)).parent
        for path in sorted([*folder.rglob("*.py"), *folder.rglob("*.toml")]):
            digest.update(str(path.relative_to(folder)).encode() + b"\0" + path.read_bytes())
    for name in ("analysis/evaluation.py", "study/work.py", "study/diagnosis.py", "study/words.py"):
        digest.update((Path(str(app.__file__)).parent / name).read_bytes())
    return digest.hexdigest()
