"""One run, one table: stages, pairs, recordings, sliders, opening and start, beside the naive way.

Run it from the project's folder on an idle machine: `make bench`. It prints the table and writes it
to benchmarks/results/last.json and .md, with the machine; `make bench-compare` compares two.
"""

import json
import os
import platform
import sys
from collections.abc import Iterator
from dataclasses import asdict
from pathlib import Path

from benchmarks.measures import clustering, files, icp, pairs, processes, sliders, surveyed, whole
from benchmarks.rows import HEADING, Row
from estimator.engines import COMPILED, REFERENCE, warm_up

RESULTS = Path(__file__).parent / "results"
_MEASURES = (clustering, icp, pairs, whole, surveyed, sliders, files, processes)


def machine() -> str:
    """Processor, system, Python and load."""
    info = Path("/proc/cpuinfo")
    lines = info.read_text().splitlines() if info.exists() else []
    models = [line.split(":")[1].strip() for line in lines if line.startswith("model name")]
    return (
        f"{os.cpu_count()} x {models[0] if models else platform.machine()}, {platform.system()}, "
        f"Python {platform.python_version()}, load {os.getloadavg()[0]:.1f} at the start"
    )


def rows() -> Iterator[Row]:
    """All rows, in order."""
    for engine in (COMPILED, REFERENCE):
        warm_up(engine)
    for measured in _MEASURES:
        yield from measured.measure()


def main() -> None:
    """Measure, print and keep the table."""
    if os.environ.get("OMP_NUM_THREADS") != "1":
        sys.exit("The naive pipeline is measured on one thread; set OMP_NUM_THREADS=1.")
    on, table = machine(), []
    print("\n".join((on, "", *HEADING)), flush=True)
    for row in rows():
        table.append(row)
        print(row.line(), flush=True)
    on += f", {os.getloadavg()[0]:.1f} at the end"
    RESULTS.mkdir(exist_ok=True)
    kept = {"machine": on, "rows": [asdict(row) for row in table]}
    (RESULTS / "last.json").write_text(json.dumps(kept, indent=2) + "\n")
    lines = ["# The last `make bench`", "", f"{on}.", "", *HEADING, *(row.line() for row in table)]
    (RESULTS / "last.md").write_text("\n".join(lines) + "\n")


if __name__ == "__main__":
    main()
