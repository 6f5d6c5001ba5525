"""Index of an MCAP file's records: from its summary, or by reading the file once."""

from mcap.opcode import Opcode
from mcap.reader import SeekingReader

from recordings.chunks import Budget
from recordings.mcap_contents import SCANNED, Contents, add_record, record_name
from recordings.mcap_records import BROKEN, MAGIC, RECORD_HEAD, RecordFile

_NAME_WITHIN = 4096  # bytes of a record


def index_of(file: RecordFile, salvage: bool) -> Contents:
    """Contents of a file.

    Args:
        file: the file.
        salvage: ignore its summary, and leave broken chunks out.

    Raises:
        One of `BROKEN`: the file is broken.
    """
    return (None if salvage else _from_summary(file)) or _scanned(file)


def _from_summary(file: RecordFile) -> Contents | None:
    try:
        return _indexed(file)
    except BROKEN:
        return None  # the summary is missing or broken


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
    for kind, indexes, into in (
        (Opcode.METADATA, summary.metadata_indexes, contents.metadata),
        (Opcode.ATTACHMENT, summary.attachment_indexes, contents.attachments),
    ):
        for index in indexes:
            into[index.name] = file.place(index.offset, kind)
    complete = (
        contents.message_count == summary.statistics.message_count
        and set(contents.locations) <= set(contents.channels)
        and all(c.schema_id in (0, *contents.schemas) for c in contents.channels.values())
        and len(summary.metadata_indexes) == summary.statistics.metadata_count
        and len(summary.attachment_indexes) == summary.statistics.attachment_count
    )
    return contents if complete else None


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
