"""Numbers of many messages at once, where their bytes have the same layout.

Messages of a stream differ in their stamps and numbers alone: names and lengths lie at the same
bytes. Only the first message of a layout is decoded; of the others the numbers are copied.
"""

import struct
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from recordings.decoding import Decoder
from recordings.mcap_contents import ChannelInfo
from recordings.message_kinds import Kind, Layout, Name

_MOST_LAYOUTS = 8
"""Layouts of messages of one length, beyond which each message is decoded."""
_AT_ONCE = 1024
"""Messages whose bytes are in memory at a time."""


@dataclass(frozen=True)
class Samples:
    """Samples of several messages, in their order.

    Attributes:
        of: (N,) number of what each is of.
        stamps: (N,) nanoseconds.
        values: (N, width).
    """

    of: NDArray[np.int64]
    stamps: NDArray[np.int64]
    values: NDArray[np.float64]

    @classmethod
    def joined(cls, parts: "list[Samples]", width: int) -> "Samples":
        """Those of several parts, one after the other."""
        nothing = np.zeros(0, np.int64)
        return cls(
            np.concatenate([nothing, *(part.of for part in parts)]),
            np.concatenate([nothing, *(part.stamps for part in parts)]),
            np.concatenate([np.zeros((0, width)), *(part.values for part in parts)]),
        )


def all_samples(
    decoder: Decoder, channel: ChannelInfo, kind: Kind, number: Callable[[Any], int]
) -> Samples:
    """Samples of all messages of a channel; arguments as in `samples_of`.

    Raises:
        BrokenFileError: the file is broken.
    """
    count, parts = decoder.count(channel), []
    for start in range(0, count, _AT_ONCE):
        payloads = decoder.payloads(channel, range(start, min(start + _AT_ONCE, count)))
        parts.append(samples_of(payloads, kind, _later(decoder, channel, start), number))
    return Samples.joined(parts, kind.width)


def _later(decoder: Decoder, channel: ChannelInfo, start: int) -> Callable[[int], Any | None]:
    return lambda index: decoder.fitting(channel, start + index)


def samples_of(
    payloads: list[bytes],
    kind: Kind,
    decode: Callable[[int], Any | None],
    number: Callable[[Any], int],
) -> Samples:
    """Samples of several messages.

    Args:
        payloads: the messages' bytes.
        kind: their type.
        decode: decodes one by its index; None where it does not fit its type.
        number: number of a name, negative where its samples are left out; it is asked in the order
            in which names appear.
    """
    by_length: dict[int, list[int]] = {}
    for index, payload in enumerate(payloads):
        by_length.setdefault(len(payload), []).append(index)
    found: list[_Alike] = []
    for indices in by_length.values():
        left = np.array(indices)
        for _ in range(_MOST_LAYOUTS):
            if len(left) == 0:
                break
            alike = _alike(payloads, left, kind, decode)
            found.append(alike)
            left = left[~np.isin(left, alike.indices)]
        found += [_decoded(index, decode(index), kind) for index in left.tolist()]
    found.sort(key=lambda alike: alike.indices[0])
    parts = [alike.samples(number) for alike in found]
    samples = Samples.joined([part for _, part in parts], kind.width)
    if len(parts) < 2:
        return samples
    order = np.argsort(np.concatenate([index for index, _ in parts]), kind="stable")
    return Samples(samples.of[order], samples.stamps[order], samples.values[order])


@dataclass(frozen=True)
class _Alike:
    """Messages that give the same names.

    Attributes:
        indices: (M,) of the messages, increasing.
        names: of what each gives.
        stamps: (M, names) nanoseconds.
        values: (M, names, width).
    """

    indices: NDArray[np.int64]
    names: list[Name]
    stamps: NDArray[np.int64]
    values: NDArray[np.float64]

    def samples(self, number: Callable[[Any], int]) -> tuple[NDArray[np.int64], Samples]:
        """Samples, message by message, and the index of the message of each."""
        numbers = np.array([number(name) for name in self.names], np.int64)
        kept = numbers >= 0
        of = np.tile(numbers[kept], len(self.indices))
        values = self.values[:, kept].reshape(len(of), self.values.shape[2])
        samples = Samples(of, self.stamps[:, kept].ravel(), values)
        return np.repeat(self.indices, kept.sum()), samples


def _alike(
    payloads: list[bytes],
    indices: NDArray[np.int64],
    kind: Kind,
    decode: Callable[[int], Any | None],
) -> _Alike:
    """Those of some messages of equal length that have the layout of the first."""
    first = _decoded(int(indices[0]), decode(int(indices[0])), kind)
    try:
        layout = kind.layout(payloads[indices[0]])
    except (struct.error, ValueError, IndexError):  # ValueError: also a text that is none
        return first
    data = np.frombuffer(b"".join([payloads[i] for i in indices.tolist()]), np.uint8)
    data = data.reshape(len(indices), -1)
    same = _fixed_bytes_agree(data, layout, kind.width)
    stamps, values = _copied(data[same], layout, kind.width)
    if (
        layout.names == first.names
        and np.array_equal(stamps[:1], first.stamps)
        and np.array_equal(values[:1], first.values, equal_nan=True)
    ):
        return _Alike(indices[same], first.names, stamps, values)
    return first


def _fixed_bytes_agree(data: NDArray[np.uint8], layout: Layout, width: int) -> NDArray[np.bool_]:
    """(M,) which messages (M, bytes) differ from the first in stamps and values alone."""
    fixed = np.ones(data.shape[1], bool)
    for at in layout.stamps:
        fixed[at : at + 8] = False
    for at in layout.values:
        fixed[at : at + 8 * width] = False
    for start, end in layout.free:
        fixed[start:end] = False
    return (data[:, fixed] == data[0, fixed]).all(axis=1)


def _copied(
    data: NDArray[np.uint8], layout: Layout, width: int
) -> tuple[NDArray[np.int64], NDArray[np.float64]]:
    """Stamps (M, names) and values (M, names, width) of messages (M, bytes) of one layout."""
    count = (len(data), len(layout.names))
    stamps, values = np.zeros(count, np.int64), np.zeros((*count, width))
    for n, (stamp, value) in enumerate(zip(layout.stamps, layout.values, strict=True)):
        stamps[:, n] = data[:, stamp : stamp + 4].copy().view("<i4")[:, 0].astype(np.int64) * 10**9
        stamps[:, n] += data[:, stamp + 4 : stamp + 8].copy().view("<u4")[:, 0]
        values[:, n] = data[:, value : value + 8 * width].copy().view("<f8")
    return stamps, values


def _decoded(index: int, message: Any | None, kind: Kind) -> _Alike:  # noqa: ANN401
    fields = [] if message is None else kind.fields(message)
    return _Alike(
        np.array([index]),
        [name for name, _, _ in fields],
        np.array([stamp for _, stamp, _ in fields], np.int64)[None],
        np.array([values for _, _, values in fields]).reshape(1, len(fields), kind.width),
    )
