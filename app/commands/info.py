"""`tofscope info`: topics of a recording, and the use of each."""

import argparse
import json
from dataclasses import asdict
from pathlib import Path
from typing import Any

from app.commands.flags.recording_flags import Opening, add_recording_flags, opening_from
from app.errors import UserError
from app.terminal.tables import ColumnStyle, show, table_of
from recordings import Provenance, Recording
from recordings.info import FileInfo, TopicInfo, file_info
from robot_assets.printable import printable

_COLUMNS = (
    ColumnStyle(["topic"]),
    ColumnStyle(["type"]),
    ColumnStyle(["messages"], right=True),
    ColumnStyle(["rate"], right=True),
    ColumnStyle(["longest gap"], right=True),
    ColumnStyle(["used as"], wraps=True),
)


def add_flags(parser: argparse.ArgumentParser) -> None:
    """Describe the subcommand, and add its flags."""
    parser.description = (
        "List the topics of an MCAP file with their types, counts, rates and longest gaps, "
        "what each will be used as, and what the recording is as a whole. The exit code is 1 "
        "where the file is not MCAP."
    )
    parser.add_argument("path", type=Path, metavar="PATH", help="an MCAP file")
    parser.add_argument("--json", action="store_true", help="print JSON")
    add_recording_flags(parser)


def run(options: argparse.Namespace) -> int:
    """Run the subcommand."""
    info = file_info(options.path)
    summary = _summary(options.path, opening_from(options))
    if options.json:
        print(json.dumps(asdict(info) | {"recording": summary}, indent=2))
    else:
        _print(info, summary)
    return 0


def _summary(path: Path, opening: Opening) -> dict[str, Any]:
    """Summary of the file as a recording, or the reason why it cannot be opened as one."""
    try:
        with opening.open(path) as recording:
            return _described(recording)
    except UserError as error:
        return {"problem": str(error)}


def _described(recording: Recording) -> dict[str, Any]:
    return {
        "frames": len(recording),
        "duration": float(recording.stamps[-1] - recording.stamps[0]),
        "sensors": [sensor.name for sensor in recording.sensors],
        "fixed_frame": recording.fixed_frame,
        "robot": recording.robot.name if recording.robot else None,
        "truth": recording.has_truth,
        "duplicates": recording.duplicates,
        "frames_outside_known_poses": int(recording.unplaced.sum()),
        "provenance": asdict(recording.provenance) if recording.provenance else None,
        "warnings": list(recording.warnings),
    }


def _print(info: FileInfo, summary: dict[str, Any]) -> None:
    _print_lines([f"{info.path}: {info.size / 1e6:.2f} MB, {info.duration:.2f} s"])
    if info.broken:
        print(f"Broken pieces of the file, {info.broken} of them, are left out.")
    if info.cut_short:
        print("The file is cut short; what it holds up to there is used.")
    print()
    show(table_of(_COLUMNS, map(_cells, info.topics)))
    print()
    _print_lines(_lines(summary))


def _print_lines(lines: list[str]) -> None:
    for line in lines:
        print(printable(line))


def _lines(summary: dict[str, Any]) -> list[str]:
    """Summary of the file as a recording."""
    if "problem" in summary:
        return [summary["problem"]]
    lines = [
        f"frames        {summary['frames']} in {summary['duration']:.2f} s, "
        f"{summary['duplicates']} duplicates dropped, "
        f"{summary['frames_outside_known_poses']} outside the known poses",
        f"sensors       {len(summary['sensors'])}: {', '.join(summary['sensors'])}",
        f"fixed frame   {summary['fixed_frame']}",
        f"robot         {summary['robot'] or 'none'}",
        f"truth         {'yes' if summary['truth'] else 'none'}",
    ]
    if summary["provenance"]:
        source = Provenance(**summary["provenance"])
        kind = "simulated" if source.simulated else "measured"
        lines += [
            f"provenance    {kind}: {source.experiment}, seed {source.seed}",
            f"noise         {source.noise}",
            *([f"rig           {source.rig}"] if source.rig else []),
            f"imperfections {', '.join(source.imperfections) or 'none'}",
            f"made by       {source.command}",
        ]
    return lines + [f"warning       {warning}" for warning in summary["warnings"]]


def _cells(topic: TopicInfo) -> list[str]:
    use = f"{topic.use}: {topic.why_not}" if topic.why_not else topic.use
    return [
        topic.topic,
        topic.type or topic.encoding,
        str(topic.messages),
        "-" if topic.rate is None else f"{topic.rate:.1f} Hz",
        "-" if topic.longest_gap is None else f"{topic.longest_gap:.3f} s",
        use,
    ]
