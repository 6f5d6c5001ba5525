"""Range format of depth images: sensor_msgs/Image with a zone per pixel."""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from recordings.errors import MisfitError
from recordings.floats import as_doubles
from recordings.grids import SIZES, Grid, is_grid, size_text
from recordings.range_format import RangeFormat

_ENCODINGS = ("16UC1", "mono16", "32FC1")


def depth_grid(image: Any) -> Grid | str:  # noqa: ANN401 (a decoded message)
    """Rows and columns of a depth image, or the reason why it is not one."""
    if not is_grid(image.height, image.width):
        return f"it is {size_text((image.height, image.width))}, and a sensor has {SIZES}"
    if image.encoding not in _ENCODINGS:
        return f"its encoding {image.encoding!r} is no distance"
    return image.height, image.width


def depth_ranges(image: Any) -> NDArray[np.float64]:  # noqa: ANN401
    """Ranges (rows, columns) in metres: 16 bit are millimetres, 32 bit metres (REP 118).

    Raises:
        MisfitError: the image has fewer bytes than its size says.
    """
    if image.encoding == "32FC1":
        return as_doubles(pixels(image, np.dtype(np.float32)))
    return pixels(image, np.dtype(np.uint16)).astype(np.float64) / 1000.0


def pixels(image: Any, kind: np.dtype[Any]) -> NDArray[Any]:  # noqa: ANN401
    """Pixels (height, width) of an image as numbers of type `kind`.

    Raises:
        MisfitError: the image has fewer bytes than its size says.
    """
    rows, columns = image.height, image.width
    needed = (rows - 1) * image.step + columns * kind.itemsize
    if image.step < columns * kind.itemsize or len(image.data) < needed:
        raise MisfitError(
            f"it has {len(image.data)} bytes in rows of {image.step}, too few for {columns} x "
            f"{rows} zones in {image.encoding}"
        )
    stored = kind.newbyteorder(">" if image.is_bigendian else "<")
    strides = (image.step, kind.itemsize)
    return np.ndarray((rows, columns), stored, bytes(image.data), strides=strides).astype(kind)


DEPTH_IMAGE = RangeFormat("sensor_msgs/Image", depth_grid, depth_ranges)
