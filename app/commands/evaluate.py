"""`tofscope evaluate`: the errors of a method on recordings with truth."""

import argparse
import json
import math
import shutil
import sys
import textwrap
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import asdict
from itertools import groupby
from pathlib import Path
from typing import Any

import numpy as np
from rich.cells import cell_len

from app.analysis.evaluation import evaluate
from app.analysis.notes import NO_TRUTH, no_pair_note, notes, truth_frame_note
from app.commands.flags.parameter_flags import add_parameter_flags, parameters_from
from app.commands.flags.recording_flags import (
    Opening,
    add_recording_flags,
    files_read,
    opening_from,
    recording_paths,
)
from app.errors import UserError
from app.output.checks import TABLE, check_output
from app.output.writing import write
from app.terminal.bar import Bar
from app.terminal.output import terminal
from estimator import ERROR_SYMBOLS, METRIC_INFO, Metrics, Parameters, to_nested
from robot_assets.printable import printable

_MEANS = tuple(key for key, info in METRIC_INFO.items() if info.kind != "count")
_NUMBER = 6
"""Characters of a number without a sign."""
_TITLES = [info.heading.split() for info in METRIC_INFO.values()]


def add_parser(commands: Any) -> None:  # noqa: ANN401 (argparse does not export the type)
    """Add the subcommand."""
    parser = commands.add_parser(
        "evaluate",
        help="errors against the truth",
        description=(
            "Estimate every pair of frames at which the object moves, and compare with the truth. "
            "The exit code is 1 where nothing could be evaluated."
        ),
        epilog=_definitions(),
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("paths", nargs="+", type=Path, metavar="PATH", help="recording or folder")
    parser.add_argument("--json", type=Path, metavar="FILE", help="write the table as JSON, too")
    add_recording_flags(parser)
    add_parameter_flags(parser)
    parser.set_defaults(run=run)


def _definitions() -> str:
    """Definitions of the columns, for the help."""
    columns = [
        f"{info.described}{f' [{info.source}]' if info.source else ''}"
        for info in METRIC_INFO.values()
    ]
    needs = (
        "What follows the velocity error needs the truth of every point. Thresholds of AccS, AccR "
        "and outliers are the field's, made for longer displacements than these."
    )
    width = shutil.get_terminal_size().columns - 2
    lines = [
        textwrap.fill(line, width, initial_indent="  ", subsequent_indent="      ")
        for line in [*columns, f"Here {ERROR_SYMBOLS}.", needs]
    ]
    return "\n".join(["columns of the table:", *lines])


def run(options: argparse.Namespace) -> int:
    """Run the subcommand."""
    parameters = parameters_from(options)
    opening = opening_from(options)
    paths = recording_paths(options.paths)
    if options.json:
        check_output(options.json, TABLE, [*paths, *files_read(options)])
    rows: list[dict[str, Any]] = []
    table = _Table([path.stem for path in paths])
    for line in table.heading():
        print(line)
    console = terminal()
    bar = Bar(console, len(paths)) if console else None
    for path in paths:
        with _shown(bar, len(rows), path.stem):
            row, warnings = _row(path, opening, parameters)
        rows.append(row)
        print(table.line(path.stem, _cells(row)), flush=True)
        for warning in warnings:
            print(printable(warning), file=sys.stderr)
    means = _means(rows)
    for mean in means:
        print(table.line(f"mean of {mean['scenario']}", _cells(mean)))
    if options.json:
        table_of_all = {"parameters": to_nested(parameters), "recordings": rows, "means": means}
        write(options.json, (json.dumps(table_of_all, indent=2) + "\n").encode())
    return 0 if any(row["pairs"] is not None for row in rows) else 1


@contextmanager
def _shown(bar: Bar | None, finished: int, name: str) -> Iterator[None]:
    """Progress bar below the table, while a recording is evaluated."""
    if bar is None:
        yield
        return
    bar.show(finished, name)
    try:
        yield
    finally:
        bar.hide()


def _row(path: Path, opening: Opening, parameters: Parameters) -> tuple[dict[str, Any], list[str]]:
    """A recording's row of the table, and its warnings."""
    row: dict[str, Any] = {"path": str(path), "scenario": None, "speed": None, "trial": None}
    row |= dict.fromkeys(METRIC_INFO)
    try:
        with opening.open(path) as recording:
            if source := recording.provenance:
                row |= {"scenario": source.scenario, "speed": source.speed, "trial": source.trial}
            metrics = evaluate(recording, parameters)
            # After the evaluation: some things are found out only when frames are read.
            warnings = [f"{path}: {sentence}" for sentence in notes(recording)]
    except UserError as error:
        return row, [str(error)]
    if metrics is None:
        return row, [*warnings, f"{path} {NO_TRUTH}."]
    if metrics.pairs == 0:
        known = "" if math.isnan(metrics.false_flow) else " Only the false flow is known."
        warnings.append(f"{path} has {no_pair_note(parameters.n)}.{known}")
    if opening.truth_frame is not None:
        warnings.append(f"{path}: {truth_frame_note(opening.truth_frame)}.")
    return row | _as_json(metrics), warnings


def _means(rows: list[dict[str, Any]]) -> list[dict[str, Any]]:
    """Means over the recordings of each scenario with more than one."""
    known = sorted((r for r in rows if r["scenario"]), key=lambda r: r["scenario"])
    means: list[dict[str, Any]] = []
    for scenario, group in groupby(known, key=lambda r: r["scenario"]):
        members = list(group)
        if len(members) < 2:
            continue
        mean: dict[str, Any] = {"scenario": scenario, "recordings": len(members)}
        for key in _MEANS:
            values = [row[key] for row in members if row[key] is not None]
            mean[key] = float(np.mean(values)) if values else None
        means.append(mean)
    return means


def _as_json(metrics: Metrics) -> dict[str, Any]:
    return {k: None if math.isnan(v) else v for k, v in asdict(metrics).items()}


def _cells(row: dict[str, Any]) -> list[str]:
    return [
        "-" if row.get(key) is None else info.text(row[key]) for key, info in METRIC_INFO.items()
    ]


class _Table:
    """Table of aligned columns, printed line by line.

    Args:
        names: of the recordings.
    """

    def __init__(self, names: list[str]) -> None:
        longest = max(cell_len(printable(name)) for name in names)
        # Names of means are longer.
        self._widths = [max(20, longest + 1)]
        for words, info in zip(_TITLES, METRIC_INFO.values(), strict=True):
            self._widths.append(max(_NUMBER + (info.kind == "signed"), *map(len, words)))

    def heading(self) -> list[str]:
        """Titles with one word a line, bottom-aligned, so that the table stays narrow."""
        height = max(map(len, _TITLES))
        columns = [[""] * (height - len(words)) + words for words in _TITLES]
        names = [""] * (height - 1) + ["recording"]
        return [self.line(name, list(c)) for name, *c in zip(names, *columns, strict=True)]

    def line(self, name: str, cells: list[str]) -> str:
        """A line of the table."""
        first, *widths = self._widths
        aligned = [cell.rjust(width) for cell, width in zip(cells, widths, strict=True)]
        shown = printable(name)
        shown += " " * (first - cell_len(shown))
        return "  ".join([shown, *aligned]).rstrip()
