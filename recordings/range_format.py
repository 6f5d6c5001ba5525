"""Range format: reader of the ranges in one type of message."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from recordings.grids import Grid


@dataclass(frozen=True)
class RangeFormat:
    """Reader of the ranges in messages of one type.

    Attributes:
        type: of the messages, such as "sensor_msgs/Image".
        grid: rows and columns of a message's ranges, or the reason why it has none, such as "its
            encoding 'rgb8' is no distance". The first message of a topic decides whether the topic
            is used.
        ranges: (rows, columns) metres along the optical axis, in the order of the message; values
            that are not finite or not above 0 are invalid. MisfitError for a broken message.
        directions: (rows, columns, 3) rays with z = 1 in the sensor's frame (REP 103, optical), NaN
            where a zone's is not known, for messages that know them; they count where neither a
            rig nor a CameraInfo gives intrinsics. None where messages know none.
    """

    type: str
    grid: Callable[[Any], Grid | str]
    ranges: Callable[[Any], NDArray[np.float64]]
    directions: Callable[[Any], NDArray[np.float64]] | None = None
