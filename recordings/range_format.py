"""Description of a type of message that holds the ranges of a sensor."""

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
        grid: rows and columns of a message's ranges, or the reason why it holds none, such as
            "its encoding 'rgb8' is no distance". The first message of a topic decides whether it
            is a sensor's.
        ranges: (rows, columns) metres along the optical axis, in the order of the message; what is
            not finite, or not above 0, is no range. RecordingError where the message is broken.
        directions: (rows, columns, 3) rays with z = 1 in the sensor's frame (REP 103, optical), NaN
            where a zone's is not known, for messages that know them; they count where neither a
            rig nor a CameraInfo gives intrinsics. None where messages know none.
    """

    type: str
    grid: Callable[[Any], Grid | str]
    ranges: Callable[[Any], NDArray[np.float64]]
    directions: Callable[[Any], NDArray[np.float64]] | None = None
