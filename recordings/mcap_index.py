"""Index of an MCAP file's records: from its summary, or by reading the file once."""

from contextlib import suppress
from io import BytesIO
from typing import Any

from mcap.data_stream import ReadDataStream
from mcap.opcode import Opcode
from mcap.reader import SeekingReader
from mcap.records import AttachmentIndex, Channel, MetadataIndex, Schema, Statistics

from recordings.chunk_indexes import PAIR, ChunkIndexes, chunk_indexes, summary_records
from recordings.chunks import Budget
from recordings.mcap_contents import SCANNED, Contents, add_record, record_name
from recordings.mcap_records import BROKEN, MAGIC, RECORD_HEAD, RecordFile

LONG = 50_000
"""Messages from which on their places are read chunk by chunk, not all at opening."""
_NAME_WITHIN = 4096  # bytes of a record
_SUMMARY: dict[int, Any] = {
    Opcode.STATISTICS: Statistics.read,
    Opcode.CHANNEL: Channel.read,
    Opcode.SCHEMA: Schema.read,
    Opcode.METADATA_INDEX: MetadataIndex.read,
    Opcode.ATTACHMENT_INDEX: AttachmentIndex.read,
}


def index_of(file: RecordFile, salvage: bool) -> tuple[Contents, ChunkIndexes | None]:
    """Contents of a file, and the index of its chunks where it is long.

    A file with `LONG` or more messages whose summary is complete is long: the contents then hold no
    locations of messages.

    Args:
        file: the file.
        salvage: ignore its summary, and leave broken chunks out.

    Raises:
        One of `BROKEN`: the file is broken.
    """
    if not salvage:
        with suppress(*BROKEN):  # the summary is missing or broken
            if (found := _long(file)) is not None:
                return found
        with suppress(*BROKEN):
            if (contents := _indexed(file)) is not None:
                return contents, None
    return _scanned(file), None


def _long(file: RecordFile) -> tuple[Contents, ChunkIndexes] | None:
    """Contents and chunks of a long file by its summary, None where it is short or incomplete."""
    records = summary_records(file)
    found = {
        kind: [read(ReadDataStream(BytesIO(record))) for record in records.get(kind, [])]
        for kind, read in _SUMMARY.items()
    }
    statistics = next(iter(found[Opcode.STATISTICS]), None)
    if statistics is None or statistics.message_count < LONG:
        return None
    indexes = chunk_indexes(records.get(Opcode.CHUNK_INDEX, []))
    Budget(file.size).take(indexes.uncompressed)
    contents = Contents(
        {channel.id: channel for channel in found[Opcode.CHANNEL]},
        {schema.id: schema for schema in found[Opcode.SCHEMA]},
    )
    counts = {n: count for n, count in statistics.channel_message_counts.items() if count}
    if int(indexes.count.sum()) > file.size // PAIR:
        return None  # indexes that point to the same records
    if indexes.counts() != counts or sum(counts.values()) != statistics.message_count:
        return None
    metadata, attachments = found[Opcode.METADATA_INDEX], found[Opcode.ATTACHMENT_INDEX]
    _add_places(file, metadata, attachments, contents)
    complete = _complete(contents, set(counts), metadata, attachments, statistics)
    return (contents, indexes) if complete else None


def _indexed(file: RecordFile) -> Contents | None:
    """Contents by the summary, None where it is missing or does not cover all messages."""
    file.stream.seek(0)
    summary = SeekingReader(file.stream).get_summary()
    if summary is None or not summary.chunk_indexes or summary.statistics is None:
        return None
    contents = Contents(dict(summary.channels), dict(summary.schemas))
    read, budget = 0, Budget(file.size)
    for index in summary.chunk_indexes:
        budget.take(index.uncompressed_size)
        for offset in index.message_index_offsets.values():
            record = file.record(offset, Opcode.MESSAGE_INDEX)
            read += len(record)
            if read > file.size:
                return None  # indexes that point to the same records
            contents.add_index(record, index.chunk_start_offset)
    metadata, attachments = summary.metadata_indexes, summary.attachment_indexes
    _add_places(file, metadata, attachments, contents)
    complete = contents.message_count == summary.statistics.message_count and _complete(
        contents, set(contents.locations), metadata, attachments, summary.statistics
    )
    return contents if complete else None


def _add_places(
    file: RecordFile,
    metadata: list[MetadataIndex],
    attachments: list[AttachmentIndex],
    contents: Contents,
) -> None:
    """Add the places of metadata and attachments to the contents."""
    for index in metadata:
        contents.metadata[index.name] = file.place(index.offset, Opcode.METADATA)
    for index in attachments:
        contents.attachments[index.name] = file.place(index.offset, Opcode.ATTACHMENT)


def _complete(
    contents: Contents,
    used: set[int],
    metadata: list[MetadataIndex],
    attachments: list[AttachmentIndex],
    statistics: Statistics,
) -> bool:
    """Whether a summary has the channels that are used, their schemas, and all records."""
    return (
        used <= set(contents.channels)
        and all(c.schema_id in (0, *contents.schemas) for c in contents.channels.values())
        and len(metadata) == statistics.metadata_count
        and len(attachments) == statistics.attachment_count
    )


def _scanned(file: RecordFile) -> Contents:
    contents, budget = Contents(), Budget(file.size)
    position = len(MAGIC)
    while True:
        file.stream.seek(position)
        head = file.stream.read(RECORD_HEAD.size)
        if len(head) < RECORD_HEAD.size:
            contents.cut_short = True
            return contents
        opcode, length = RECORD_HEAD.unpack(head)
        if opcode == Opcode.DATA_END:
            return contents
        start = position + RECORD_HEAD.size
        if start + length > file.size:
            contents.cut_short = True
            return contents
        try:
            if opcode in SCANNED:
                add_record(contents, opcode, file.content(start, length), position, budget)
            elif opcode in (Opcode.METADATA, Opcode.ATTACHMENT):
                name = record_name(opcode, file.content(start, min(length, _NAME_WITHIN)))
                into = contents.metadata if opcode == Opcode.METADATA else contents.attachments
                into[name] = start, length
        except BROKEN:
            # Records are independent: those after a broken one can still be read.
            contents.broken_chunks += 1
        position = start + length
