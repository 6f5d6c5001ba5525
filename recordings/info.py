"""Summary of an MCAP file and its topics."""

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from recordings.contents import Topic, topics_of
from recordings.decoding import Decoder
from recordings.errors import BrokenFileError
from recordings.mcap_file import McapFile


@dataclass(frozen=True)
class TopicInfo:
    """Summary of a topic; times are log times.

    Attributes:
        topic: its name.
        type: name of its schema.
        encoding: of its messages.
        messages: number of messages.
        rate: mean messages per second, None for fewer than two.
        longest_gap: seconds, None for fewer than two.
        use: of the topic.
        why_not: reason why it is not used, "" where it is.
    """

    topic: str
    type: str
    encoding: str
    messages: int
    rate: float | None
    longest_gap: float | None
    use: str
    why_not: str


@dataclass(frozen=True)
class FileInfo:
    """Summary of an MCAP file.

    Attributes:
        path: of the file.
        size: bytes.
        duration: seconds between the first and the last message.
        topics: in natural order.
        cut_short: whether the end of the file is missing.
        broken: number of broken records that are left out.
    """

    path: str
    size: int
    duration: float
    topics: tuple[TopicInfo, ...]
    cut_short: bool
    broken: int


def file_info(path: str | Path) -> FileInfo:
    """Summarise an MCAP file, whether or not it can be opened as a recording.

    Raises:
        RecordingError: it cannot be read as MCAP.
    """
    try:
        return _file_info(McapFile(Path(path)), path)
    except BrokenFileError:
        return _file_info(McapFile(Path(path), salvage=True), path)


def _file_info(file: McapFile, path: str | Path) -> FileInfo:
    try:
        topics = topics_of(file, Decoder(file))
        times = np.concatenate(
            [file.table(topic.channel).log_time for topic in topics] or [np.zeros(0)]
        )
        return FileInfo(
            path=str(path),
            size=file.path.stat().st_size,
            duration=float(times.max() - times.min()) * 1e-9 if len(times) else 0.0,
            topics=tuple(_topic_info(topic, file) for topic in topics),
            cut_short=file.cut_short,
            broken=file.broken_chunks,
        )
    finally:
        file.close()


def _topic_info(topic: Topic, file: McapFile) -> TopicInfo:
    times = file.table(topic.channel).log_time
    gaps = np.diff(times) * 1e-9
    lasted = float(gaps.sum())
    return TopicInfo(
        topic=topic.name,
        type=topic.channel.schema_name,
        encoding=topic.channel.encoding,
        messages=len(times),
        rate=len(gaps) / lasted if lasted > 0 else None,
        longest_gap=float(gaps.max()) if len(gaps) else None,
        use=topic.use.value,
        why_not=topic.why_not,
    )
