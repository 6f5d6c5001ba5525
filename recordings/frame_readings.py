"""Readings of all sensors at one frame."""

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from recordings.cloud import NO_STATUS
from recordings.decoding import Decoder
from recordings.errors import MisfitError
from recordings.grids import Grid
from recordings.sensors import DepthStream, distances, status_codes, valid


class FrameReadings:
    """Reader of the messages that make up a frame.

    Args:
        streams: of the sensors.
        decoder: of the file; what cannot be used is noted there.
        grid: rows R and columns C of zones, at least those of every sensor.
    """

    def __init__(self, streams: Sequence[DepthStream], decoder: Decoder, grid: Grid) -> None:
        self._streams, self._decoder = streams, decoder
        self._shape = (len(streams), *grid)
        self._limits = np.array([stream.sensor.limits for stream in streams])

    def at(
        self, messages: NDArray[np.int64]
    ) -> tuple[NDArray[np.float64], NDArray[np.uint8] | None]:
        """Readings of some messages.

        Args:
            messages: (S,) index of each sensor's message, -1 where it has none.

        Returns:
            Readings (S, R, C) in metres, NaN where invalid, and ST's target status (S, R, C),
            `NO_STATUS` where a sensor has none; None where no sensor has any.
        """
        values = np.full(self._shape, np.nan)
        status = np.full(self._shape, NO_STATUS, dtype=np.uint8)
        with_status = np.zeros(len(self._streams), dtype=bool)
        for s, index in enumerate(messages.tolist()):
            found = self._read(self._streams[s], index) if index >= 0 else None
            if found is None:
                continue
            rows, columns = self._streams[s].sensor.grid
            values[s, :rows, :columns], codes = found
            if codes is not None:
                status[s, :rows, :columns] = codes
                with_status[s] = True
        values[~valid(values, status, with_status, self._limits)] = np.nan
        return values, status if with_status.any() else None

    def _read(
        self, stream: DepthStream, index: int
    ) -> tuple[NDArray[np.float64], NDArray[np.uint8] | None] | None:
        """What a sensor's message says, and its status, None without; None where it is not used."""
        if (message := self._decoder.readable(stream.topic.channel, index)) is None:
            return None
        status: Any | None = None
        if stream.status and (row := int(stream.status_index[index])) >= 0:
            status = self._decoder.readable(stream.status.channel, row)
            if status is None:
                return None  # ranges may be valid or not
        try:
            codes = None if status is None else status_codes(status, stream.sensor)
            return distances(message, stream.sensor, stream.form), codes
        except MisfitError as error:
            # One bad message does not cost the frame; only this sensor is left out.
            self._decoder.leave_out(stream.topic.channel, index, str(error))
            return None
