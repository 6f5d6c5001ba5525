"""Fields of point clouds: sensor_msgs/PointCloud2."""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from recordings.errors import MisfitError, few

# sensor_msgs/PointField: the number of a datatype, and NumPy's letter for it.
MOST_POINTS = 2**18
"""Points of a cloud, as many as a recording's zones may be."""
_KINDS = {1: "i1", 2: "u1", 3: "i2", 4: "u2", 5: "i4", 6: "u4", 7: "f4", 8: "f8"}


def fields_of(cloud: Any) -> dict[str, NDArray[Any]]:  # noqa: ANN401 (a decoded message)
    """Fields of a cloud, (height * width,) each, in the order of the points.

    Raises:
        MisfitError: the cloud has too few bytes for its size, or fields that do not fit.
    """
    names, step = [field.name for field in cloud.fields], cloud.point_step
    count = cloud.width * cloud.height
    if count == 0:
        return {name: np.zeros(0) for name in names}
    if count > MOST_POINTS:
        raise MisfitError(f"it has {count} points, more than {MOST_POINTS}")
    row_step = max(cloud.row_step, cloud.width * step)
    needed = (cloud.height - 1) * row_step + cloud.width * step
    data = bytes(cloud.data)
    fits = all(
        f.datatype in _KINDS and f.offset + np.dtype(_KINDS[f.datatype]).itemsize <= step
        for f in cloud.fields
    )
    if not names or len(data) < needed or not fits or len(set(names)) < len(names):
        raise MisfitError(
            f"it has {len(data)} bytes for {count} points of {step}, and the "
            f"fields {few(names)}, which does not fit together"
        )
    order = ">" if cloud.is_bigendian else "<"
    layout = np.dtype(
        {
            "names": names,
            "formats": [order + _KINDS[f.datatype] for f in cloud.fields],
            "offsets": [f.offset for f in cloud.fields],
            "itemsize": step,
        }
    )
    shape, strides = (cloud.height, cloud.width), (row_step, step)
    points = np.ndarray(shape, layout, data, strides=strides).reshape(-1)
    return {name: points[name] for name in names}
