"""Random mutants of good recordings."""

import re
import struct
from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import TypeVar

import numpy as np
from mcap.writer import CompressionType

from tests.fuzz.container import Container, read, written

_T = TypeVar("_T")
_NUMBERS = (0.0, -1.0, 1e-320, 1e-12, 1e38, 1e308, np.inf, -np.inf, np.nan)
_WHOLE = (0, 1, 0x7F, 0xFF, 0x7FFFFFFF, 0x80000000, 0xFFFFFFFF)
_TEXTS = ("", "nan", "inf", "-1", "0", "1e308", "1e-320", "1 2", "x", "9" * 5000, "/", "é\x1b[31m")


def mutant(content: bytes, rng: np.random.Generator) -> bytes:
    """Change a good recording at random, on one of its levels."""
    change = _one(rng, _CHANGES)
    for _ in range(int(rng.integers(1, 4))):
        content = change(content, rng)
    return content


def _flipped(content: bytes, rng: np.random.Generator) -> bytes:
    changed = bytearray(content)
    for place in rng.integers(0, max(len(changed), 1), int(rng.integers(1, 12))).tolist():
        if place < len(changed):
            changed[place] ^= int(rng.integers(1, 256))
    return bytes(changed)


def _sliced(content: bytes, rng: np.random.Generator) -> bytes:
    """Bytes cut off, left out, doubled, or overwritten by zeros."""
    a, b = sorted(rng.integers(0, len(content) + 1, 2).tolist())
    b = min(b, a + int(rng.choice([1, 8, 200, len(content)])))
    return _one(
        rng,
        [
            content[:a],
            content[:a] + content[b:],
            content[:b] + content[a:],
            content[:a] + bytes(b - a) + content[b:],
        ],
    )


def _numbers_in_records(content: bytes, rng: np.random.Generator) -> bytes:
    """Eight bytes somewhere, as a length or an offset would be, become another number."""
    changed = bytearray(content)
    at = int(rng.integers(0, max(len(content) - 8, 1)))
    number = int(_one(rng, [*_WHOLE, 2**32, 2**40, 2**63, 2**64 - 1, len(content)]))
    changed[at : at + 8] = struct.pack("<Q", number)
    return bytes(changed)


def _parts(change: Callable[[Container, np.random.Generator], Container]):
    def changed(content: bytes, rng: np.random.Generator) -> bytes:
        try:
            container = read(content)
        except Exception:  # a mutant already, which no reader takes
            return _flipped(content, rng)
        if not container.messages:
            return _sliced(content, rng)
        return written(change(container, rng), _one(rng, list(CompressionType)))

    return changed


def _payload(container: Container, rng: np.random.Generator) -> Container:
    """One message or all of a topic, with other bytes inside."""
    index = int(rng.integers(len(container.messages)))
    topic = container.messages[index].topic
    change = _one(rng, [_flipped, _sliced, _number, _whole])
    chosen = [i for i, m in enumerate(container.messages) if m.topic == topic]
    for i in chosen if rng.random() < 0.4 else [index]:
        data = container.messages[i].data
        container = container.with_message(i, data=change(data, rng))
    return container


def _number(data: bytes, rng: np.random.Generator) -> bytes:
    return _put(data, struct.pack("<d", float(_one(rng, _NUMBERS))), 8, rng)


def _whole(data: bytes, rng: np.random.Generator) -> bytes:
    return _put(data, struct.pack("<I", int(_one(rng, _WHOLE))), 4, rng)


def _put(data: bytes, value: bytes, step: int, rng: np.random.Generator) -> bytes:
    """Data with a value at a place where CDR would have one."""
    places = range(4, len(data) - len(value) + 1, step)
    if not places:
        return data
    at = int(rng.choice(places))
    return data[:at] + value + data[at + len(value) :]


def _schema(container: Container, rng: np.random.Generator) -> Container:
    """The definition of a type with lines lost, doubled, renamed, or of another type."""
    message = _one(rng, container.messages)
    lines = message.schema.decode("utf-8", "replace").split("\n")
    at = int(rng.integers(len(lines)))
    words = lines[at].split()
    other = _one(rng, ["float64", "string", "uint8[]", "geometry_msgs/Pose", "x[2147483647]"])
    lines[at : at + 1] = _one(
        rng,
        [
            [],
            [lines[at]] * 2,
            [f"{other} {' '.join(words[1:])}"],
            [" ".join([*words[:1], "other"])],
            [lines[at][: len(lines[at]) // 2]],
        ],
    )
    return container.with_kind(message.kind, schema="\n".join(lines).encode())


def _names(container: Container, rng: np.random.Generator) -> Container:
    """Another topic, type or encoding for all messages of a topic."""
    topic = _one(rng, container.messages).topic
    kinds = sorted({message.kind for message in container.messages})
    change: dict[str, object] = _one(
        rng,
        [
            {"topic": topic + _one(rng, _TEXTS)},
            {"topic": _one(rng, container.messages).topic},
            {"topic": _one(rng, ["/tf", "/tf_static", "/joint_states", "/" * 50, "a" * 2000])},
            {"kind": _one(rng, kinds)},
            {"encoding": _one(rng, ["ros2idl", "protobuf", ""])},
        ],
    )
    messages = [m._replace(**change) if m.topic == topic else m for m in container.messages]
    return replace(container, messages=messages)


def _texts(container: Container, rng: np.random.Generator) -> Container:
    """Values of the description of the robot, or of the records of our writer, replaced."""
    descriptions = [i for i, m in enumerate(container.messages) if b"<robot" in m.data]
    if descriptions and rng.random() < 0.8:
        index = int(rng.choice(descriptions))
        text = container.messages[index].data[8:-1].decode("utf-8", "replace")
        return container.with_message(index, data=_string(_description(text, rng)))
    metadata = {
        name: {key: _one(rng, [value, *_TEXTS]) for key, value in record.items()}
        for name, record in container.metadata.items()
    }
    attachments = {name: _flipped(data, rng) for name, data in container.attachments.items()}
    return replace(container, metadata=metadata, attachments=attachments)


def _description(text: str, rng: np.random.Generator) -> str:
    values = [m.span(1) for m in re.finditer(r'="([^"]*)"', text)]
    if rng.random() < 0.3 or not values:
        return _sliced(text.encode(), rng).decode("utf-8", "replace")
    for start, end in [values[i] for i in sorted(rng.integers(0, len(values), 2), reverse=True)]:
        text = text[:start] + _one(rng, _TEXTS).replace("\x1b", "") + text[end:]
    return text


def _string(text: str) -> bytes:
    """A std_msgs/String in CDR."""
    data = text.encode("utf-8", "replace") + b"\0"
    return b"\x00\x01\x00\x00" + struct.pack("<I", len(data)) + data


def _order(container: Container, rng: np.random.Generator) -> Container:
    """Messages lost, doubled, or of another time."""
    messages = list(container.messages)
    for _ in range(int(rng.integers(1, 6))):
        at = int(rng.integers(len(messages)))
        stamp = int(_one(rng, [0, 1, 2**62, 2**63, 2**64 - 1, messages[at].stamp]))
        messages[at : at + 1] = _one(
            rng, [[], [messages[at]] * 3, [messages[at]._replace(stamp=stamp)]]
        )
        if not messages:
            return container
    return replace(container, messages=messages)


_CHANGES = (
    _flipped,
    _sliced,
    _numbers_in_records,
    *(_parts(change) for change in (_payload, _payload, _payload, _schema, _names, _texts, _order)),
)


def _one(rng: np.random.Generator, choices: Sequence[_T]) -> _T:
    return choices[int(rng.integers(len(choices)))]
