"""Print MB in use after the pairs of a recording are estimated: `python -m ... RECORDING`."""

import sys
from pathlib import Path

from benchmarks.inputs import WHOLE, windows_of
from estimator import Parameters, estimate


def main() -> None:
    """Estimate, and keep the windows while memory is read (Linux alone tells)."""
    windows = windows_of(Path(sys.argv[1]))[:WHOLE]
    flows = [estimate(window, Parameters()) for window in windows]
    status = Path("/proc/self/status").read_text().splitlines()
    resident = next(line for line in status if line.startswith("VmRSS:"))
    assert len(flows) == WHOLE
    print(int(resident.split()[1]) / 1024)


if __name__ == "__main__":
    main()
