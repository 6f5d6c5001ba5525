"""Decoded images."""

from types import SimpleNamespace

import numpy as np


def picture(values: np.ndarray, encoding: str, **more: object) -> SimpleNamespace:
    """A sensor_msgs/Image of these pixels; `more` are fields with other contents."""
    fields = {
        "header": SimpleNamespace(frame_id="eye"),
        "height": values.shape[0],
        "width": values.shape[1],
        "encoding": encoding,
        "is_bigendian": values.dtype.byteorder == ">",
        "step": values.shape[1] * values.dtype.itemsize,
        "data": np.frombuffer(values.tobytes(), np.uint8),
    }
    return SimpleNamespace(**(fields | more))
