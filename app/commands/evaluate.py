"""`tofscope evaluate`: the errors of a method on recordings with truth."""

import argparse
import json
import shutil
import sys
import textwrap
from collections.abc import Generator
from contextlib import closing
from functools import partial
from itertools import groupby
from pathlib import Path
from typing import Any

import numpy as np

from app.analysis.method_files import method_files
from app.commands.evaluate_row import Asked, Row, row_of, row_without_errors
from app.commands.flags.engine_flags import add_engine_flag, choose_engine
from app.commands.flags.execution_flags import add_execution_flags, check_jobs
from app.commands.flags.parameter_flags import add_parameter_flags, parameters_from
from app.commands.flags.recording_flags import (
    add_recording_flags,
    files_read,
    opening_from,
    recording_paths,
    with_absolute_paths,
)
from app.execution.each import Call, Place, results
from app.output.checks import TABLE, check_output
from app.output.writing import write
from app.study.software import software_digest
from app.terminal.bar import Bar
from app.terminal.output import terminal
from estimator import ERROR_SYMBOLS, METRIC_INFO, to_nested
from robot_assets.printable import printable

_MEANS = tuple(key for key, info in METRIC_INFO.items() if info.kind != "count")
_NUMBER = 6
"""Characters of a number without a sign."""
_TITLES = [info.heading.split() for info in METRIC_INFO.values()]


def add_flags(parser: argparse.ArgumentParser) -> None:
    """Describe the subcommand, and add its flags."""
    parser.description = (
        "Estimate every pair of frames at which the object moves, and compare with the truth. "
        "The exit code is 1 where nothing could be evaluated."
    )
    parser.epilog = _definitions()
    parser.formatter_class = argparse.RawDescriptionHelpFormatter
    parser.add_argument("paths", nargs="+", type=Path, metavar="PATH", help="recording or folder")
    parser.add_argument("--json", type=Path, metavar="FILE", help="write the table as JSON, too")
    add_execution_flags(parser)
    add_recording_flags(parser)
    add_engine_flag(parser)
    add_parameter_flags(parser)


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
    check_jobs(options)
    if options.dask:
        options = with_absolute_paths(options)
    parameters = parameters_from(options)
    opening = opening_from(options)
    paths = recording_paths(options.paths)
    if options.json:
        check_output(options.json, TABLE, [*paths, *files_read(options)])
    choose_engine(options.engine)
    files = method_files([parameters.method])
    asked = Asked(opening, parameters, files, software_digest(files))
    table = _Table([path.stem for path in paths])
    for line in table.heading():
        print(line)
    rows: list[dict[str, Any]] = []
    with closing(_in_order(paths, asked, Place(options.jobs, options.dask, files))) as done:
        for path, row in done:
            rows.append(row.values | {"path": str(path)})
            print(table.line(path.stem, _cells(row.values)), flush=True)
            for warning in row.warnings:
                print(printable(warning), file=sys.stderr)
    means = _means(rows)
    for mean in means:
        print(table.line(f"mean of {mean['scenario']}", _cells(mean)))
    if options.json:
        table_of_all = {
            "parameters": to_nested(parameters),
            "engine": options.engine,
            "recordings": rows,
            "means": means,
        }
        write(options.json, (json.dumps(table_of_all, indent=2) + "\n").encode())
    return 0 if any(row["pairs"] is not None for row in rows) else 1


def _in_order(
    paths: list[Path], asked: Asked, place: Place
) -> Generator[tuple[Path, Row], None, None]:
    """Evaluate recordings, and yield each with its row in their order, below it a bar meanwhile."""
    console = terminal()
    bar = Bar(console, len(paths)) if console else None
    waiting: dict[int, Row] = {}
    shown = 0
    # Workers of a cluster run in folders of their own.
    opened = [path.absolute() for path in paths] if place.dask else paths
    call = Call(partial(row_of, asked=asked), _lost)
    try:
        with closing(results(call, opened, place)) as done:
            while shown < len(paths):
                if bar:
                    bar.show(shown + len(waiting), paths[shown].stem)
                index, row = next(done)
                waiting[index] = row
                if bar and shown in waiting:
                    bar.hide()
                while shown in waiting:
                    yield paths[shown], waiting.pop(shown)
                    shown += 1
    finally:
        if bar:
            bar.hide()


def _lost(path: Path, reason: str) -> Row:
    return row_without_errors(path, f"{path}: {reason}.")


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
        from rich.cells import cell_len

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
        from rich.cells import cell_len

        first, *widths = self._widths
        aligned = [cell.rjust(width) for cell, width in zip(cells, widths, strict=True)]
        shown = printable(name)
        shown += " " * (first - cell_len(shown))
        return "  ".join([shown, *aligned]).rstrip()
