"""Imports of the reference's libraries, when they are first needed and one at a time.

Each takes a second, which the command line's help does not need. Both bring packages of which some
are the same, and Python refuses imports of two threads that wait for each other.
"""

import threading
from typing import Any

_importing = threading.RLock()


def open3d() -> Any:  # noqa: ANN401 (it has no types)
    """The module `open3d`."""
    with _importing:
        import open3d

        return open3d


def scikit_learn_hdbscan() -> Any:  # noqa: ANN401 (its types are inferred from its defaults)
    """The class `sklearn.cluster.HDBSCAN`."""
    with _importing:
        from sklearn.cluster import HDBSCAN

        return HDBSCAN
