"""Floats of messages in double precision."""

from typing import Any

import numpy as np
from numpy.typing import NDArray


def as_doubles(values: NDArray[Any]) -> NDArray[np.float64]:
    """Numbers of any type as float64; NumPy's warning about signalling NaNs is left out."""
    with np.errstate(invalid="ignore"):
        return values.astype(np.float64)
