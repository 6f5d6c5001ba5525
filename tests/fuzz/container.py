"""Parts of an MCAP file that can be changed and written again."""

from dataclasses import dataclass, field, replace
from io import BytesIO
from typing import NamedTuple

from mcap.reader import make_reader
from mcap.writer import CompressionType, Writer


class Message(NamedTuple):
    """A message with its topic and type."""

    topic: str
    kind: str
    schema: bytes
    encoding: str
    stamp: int
    data: bytes


@dataclass(frozen=True)
class Container:
    """Content of an MCAP file."""

    messages: list[Message]
    metadata: dict[str, dict[str, str]] = field(default_factory=dict)
    attachments: dict[str, bytes] = field(default_factory=dict)

    def with_message(self, index: int, **changes: object) -> "Container":
        """The same with one message changed."""
        messages = list(self.messages)
        messages[index] = messages[index]._replace(**changes)
        return replace(self, messages=messages)

    def with_kind(self, kind: str, **changes: object) -> "Container":
        """The same with all messages of one type changed."""
        messages = [m._replace(**changes) if m.kind == kind else m for m in self.messages]
        return replace(self, messages=messages)

    def index_of(self, topic: str) -> int:
        """Index of the first message of a topic."""
        return next(i for i, message in enumerate(self.messages) if message.topic == topic)


def read(content: bytes) -> Container:
    """Parts of a good file."""
    reader = make_reader(BytesIO(content))
    messages = [
        Message(c.topic, s.name, s.data, s.encoding, m.log_time, m.data)
        for s, c, m in reader.iter_messages()
        if s is not None
    ]
    return Container(
        messages,
        {record.name: record.metadata for record in reader.iter_metadata()},
        {record.name: record.data for record in reader.iter_attachments()},
    )


def written(container: Container, compression: CompressionType = CompressionType.ZSTD) -> bytes:
    """A file with these parts."""
    buffer = BytesIO()
    writer = Writer(buffer, chunk_size=4096, compression=compression)
    writer.start("ros2")
    for name, record in container.metadata.items():
        writer.add_metadata(name, record)
    schemas: dict[tuple[str, bytes, str], int] = {}
    channels: dict[tuple[str, int], int] = {}
    for message in container.messages:
        schema = message.kind, message.schema, message.encoding
        if schema not in schemas:
            schemas[schema] = writer.register_schema(message.kind, message.encoding, message.schema)
        channel = message.topic, schemas[schema]
        if channel not in channels:
            channels[channel] = writer.register_channel(message.topic, "cdr", schemas[schema])
        writer.add_message(channels[channel], message.stamp, message.data, message.stamp)
    for name, data in container.attachments.items():
        writer.add_attachment(0, 0, name, "", data)
    writer.finish()
    return buffer.getvalue()
