"""Flow of a recording's source points as a file: CSV for spreadsheets, NPZ for NumPy."""

import csv
import io
import json
from collections.abc import Callable, Iterable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from app.analysis.pairs import Pair
from app.errors import InputError
from app.exports.captions import caption
from app.output.export_kinds import FLOW_HEADING, FLOW_MARK, MADE_WITH
from app.output.text import csv_cell, escaped, utf8
from estimator import Label, Parameters
from recordings import Recording

CSV, NPZ = "csv", "npz"


@dataclass(frozen=True)
class FlowTable:
    """Source points of one or several pairs, and what was estimated of each.

    Attributes:
        frames: (F,) k of each pair.
        intervals: (F,) seconds between source and target of each.
        columns: {name: (N,)} of all points: frame, x y z in metres and vx vy vz in m/s in the fixed
            frame, label, cluster, sensor, zone. The velocity of what does not move is NaN.
        several: whether a file says of each point which frame it is of.
    """

    frames: NDArray[np.int64]
    intervals: NDArray[np.float64]
    columns: dict[str, NDArray[np.generic]]
    several: bool

    def __len__(self) -> int:
        return len(self.columns["frame"])


def flow_table(pairs: Iterable[Pair], *, several: bool) -> FlowTable:
    """Table of the pairs that have a flow.

    Args:
        pairs: estimated.
        several: whether they are a range, even if it holds only one.

    Raises:
        InputError: none has one.
    """
    found = [pair for pair in pairs if pair.source is not None and pair.flow is not None]
    if not found:
        raise InputError(
            "There is no flow: no frame lies n before; choose a later frame, or a smaller n."
        )
    tables: list[dict[str, NDArray[np.generic]]] = []
    for pair in found:
        assert pair.source is not None
        assert pair.flow is not None
        points, velocity = pair.source.points, pair.flow.velocity
        tables.append(
            {
                "frame": np.full(len(points), pair.frame),
                **dict(zip("xyz", points.T, strict=True)),
                **dict(zip(("vx", "vy", "vz"), velocity.T, strict=True)),
                "label": np.asarray(pair.flow.label),
                "cluster": np.asarray(pair.flow.cluster),
                "sensor": np.asarray(pair.source.sensor),
                "zone": np.asarray(pair.source.zone),
            }
        )
    return FlowTable(
        np.array([pair.frame for pair in found]),
        np.array([pair.interval for pair in found]),
        {name: np.concatenate([table[name] for table in tables]) for name in tables[0]},
        several,
    )


def flow_file(recording: Recording, parameters: Parameters, table: FlowTable, kind: str) -> bytes:
    """The table as a file that says of itself what it shows.

    Args:
        recording: of the pairs.
        parameters: of the estimate.
        table: of one pair, or of several, whose frame is then the first column.
        kind: `CSV` or `NPZ`.
    """
    frame = None if table.several else int(table.frames[0])
    about = dict(caption(recording, parameters, frame))
    return _FILES[kind](recording, table, about)


def _csv(recording: Recording, table: FlowTable, about: dict[str, str]) -> bytes:
    """CSV: comment lines, a header, and a line per point; what is undefined is empty."""
    columns = _columns(table)
    texts = [_texts(values) for values in columns.values()]
    text = io.StringIO()
    labels = ", ".join(f"{label.value} {label.name.lower()}" for label in Label)
    names = ", ".join(f"{i} {escaped(sensor.name)}" for i, sensor in enumerate(recording.sensors))
    for line in (
        f"{FLOW_HEADING}; {json.dumps(about, ensure_ascii=False)}",
        f"x y z [m] and vx vy vz [m/s] in {recording.fixed_frame}; label: {labels}",
        f"sensor: {names}",
    ):
        # A line break in a name would end the comment.
        text.write(f"# {' '.join(line.split())}\n")
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(columns)
    writer.writerows(map(csv_cell, row) for row in zip(*texts, strict=True))
    return utf8(text.getvalue())


def _npz(recording: Recording, table: FlowTable, about: dict[str, str]) -> bytes:
    """NPZ: an array per column, and what explains them."""
    explained = {
        FLOW_MARK: MADE_WITH,
        "about": json.dumps(about, ensure_ascii=False),
        "labels": [label.name.lower() for label in Label],
        "sensors": [escaped(sensor.name) for sensor in recording.sensors],
        "frames": table.frames,
        "stamps": recording.stamps[table.frames],
        "intervals": table.intervals,
    }
    content = io.BytesIO()
    np.savez_compressed(
        content,
        allow_pickle=False,
        **_columns(table),
        **{name: np.asarray(value) for name, value in explained.items()},
    )
    return content.getvalue()


_FILES: dict[str, Callable[[Recording, FlowTable, dict[str, str]], bytes]] = {
    CSV: _csv,
    NPZ: _npz,
}


def _columns(table: FlowTable) -> dict[str, NDArray[np.generic]]:
    """Columns of a file, in order."""
    return {
        name: values for name, values in table.columns.items() if name != "frame" or table.several
    }


def _texts(values: NDArray[np.generic]) -> list[str]:
    if values.dtype.kind != "f":
        return [str(value) for value in values]
    return [format(value, ".6g") if np.isfinite(value) else "" for value in values.tolist()]
