"""Two tables of `make bench` side by side.

Run it from the project's folder: `make bench-compare` compares the table of the last commit with
that of the last run, `make bench-compare ARGS="BEFORE.json AFTER.json"` any two. Ratios to the
naive pipeline are compared where there are any, since machines and their loads differ.
"""

import argparse
import json
import subprocess
import sys
from pathlib import Path

from benchmarks.rows import Row

REPOSITORY = Path(__file__).parent.parent
LAST = REPOSITORY / "benchmarks" / "results" / "last.json"


def read(text: str, where: str) -> dict[str, Row]:
    """{name: row} of a table.

    Args:
        text: of the JSON file.
        where: it is from, for the error.

    Raises:
        ValueError: it is no table of `make bench`.
    """
    try:
        return {row["name"]: Row(**row) for row in json.loads(text)["rows"]}
    except (ValueError, TypeError, KeyError) as error:
        raise ValueError(f"{where} is not a table of make bench.") from error


def kept() -> str:
    """The table of the last commit.

    Raises:
        ValueError: there is none, or no git.
    """
    command = ["git", "show", f"HEAD:./{LAST.relative_to(REPOSITORY)}"]
    try:
        return subprocess.run(
            command, cwd=REPOSITORY, check=True, capture_output=True, text=True
        ).stdout
    except (OSError, subprocess.CalledProcessError) as error:
        raise ValueError("The last commit has no table; give two JSON files.") from error


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
    """Print the comparison; of input that is no table, one sentence."""
    parser = argparse.ArgumentParser(description="Compare two tables of make bench.")
    parser.add_argument("tables", nargs="*", type=Path, metavar="TABLE", help="before, and after")
    paths = parser.parse_args().tables
    if len(paths) not in (0, 2):
        parser.error("give two tables, or none for the committed one and the last run")
    try:
        before = read(paths[0].read_text(), str(paths[0])) if paths else read(kept(), "HEAD's")
        after = paths[1] if paths else LAST
        print("\n".join(lines(before, read(after.read_text(), str(after)))))
    except (OSError, ValueError) as error:
        sys.exit(str(error))


if __name__ == "__main__":
    main()
