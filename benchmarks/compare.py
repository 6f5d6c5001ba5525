"""Two tables of `make bench` side by side.

Run it from the project's folder: `make bench-compare ARGS="BEFORE.json AFTER.json"`. Ratios to the
naive pipeline are compared where there are any, since machines and their loads differ.
"""

import argparse
import json
from pathlib import Path

from benchmarks.rows import Row


def read(path: Path) -> dict[str, Row]:
    """{name: row} of a table."""
    return {row["name"]: Row(**row) for row in json.loads(path.read_text())["rows"]}


def lines(before: dict[str, Row], after: dict[str, Row]) -> list[str]:
    """A line for each row of either table."""
    found = ["| what | before | after | gain |", "|---|---:|---:|---:|"]
    for name in before | after:
        old, new = before.get(name), after.get(name)
        if old is None or new is None:
            found.append(f"| {name} | {_text(old)} | {_text(new)} | |")
            continue
        gain = old.value / new.value
        if old.ratio is not None and new.ratio is not None:
            gain = new.ratio / old.ratio
        found.append(f"| {name} | {_text(old)} | {_text(new)} | {gain:.2f} |")
    return found


def _text(row: Row | None) -> str:
    if row is None:
        return "not measured"
    ratio = "" if row.ratio is None else f" ({row.ratio:.1f}x)"
    return f"{row.value:.2f} {row.unit}{ratio}"


def main() -> None:
    """Print the comparison."""
    parser = argparse.ArgumentParser(description="Compare two tables of make bench.")
    parser.add_argument("before", type=Path)
    parser.add_argument("after", type=Path)
    options = parser.parse_args()
    print("\n".join(lines(read(options.before), read(options.after))))


if __name__ == "__main__":
    main()
