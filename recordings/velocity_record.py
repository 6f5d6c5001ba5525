"""Attachment with the truth's velocities of a long recording, so that all are known at opening."""

import zlib
from array import array

import numpy as np
from numpy.typing import NDArray

VELOCITIES = "target_velocity.zlib"
"""Name of the attachment: of each message of `VELOCITY_TOPIC` six little-endian doubles, zlib."""
VELOCITIES_TYPE = "application/zlib"
VELOCITY_TOPIC = "/target/velocity"
MANY = 20_000
"""Messages from which on the velocities are attached."""
BYTES = 48
"""Of a velocity and an angular velocity, at the end of a TwistStamped."""


def pack_velocities(values: "array[float]") -> bytes:
    """Pack linear and angular velocities, one message after the other."""
    return zlib.compress(np.array(values, "<f8").tobytes())


def unpack_velocities(data: bytes, count: int) -> NDArray[np.float64] | None:
    """Velocities (N, 6): m/s and rad/s; None unless the attachment holds so many and no more."""
    try:
        values = zlib.decompressobj().decompress(data, count * BYTES + 1)
    except zlib.error:
        return None
    return np.frombuffer(values, "<f8").reshape(-1, 6) if len(values) == count * BYTES else None
