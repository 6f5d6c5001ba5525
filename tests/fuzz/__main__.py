"""`make fuzz`: thousands of mutants of good recordings, and all files that are named.

Runs in one process of bounded memory. Files that show a fault are kept, and end the run with 1.
"""

import argparse
import collections
import resource
import sys
import time
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np

from tests.fuzz.handmade import HANDMADE
from tests.fuzz.limits import CPU_SECONDS
from tests.fuzz.mutants import mutant
from tests.fuzz.seeds import seeds
from tests.fuzz.trial import Outcome, tried

_MOST_MEMORY = 2_500_000_000  # bytes, so that a bomb ends the trial and not the machine


def main() -> int:
    """Try mutants, handmade files and named files; returns the exit code."""
    parser = argparse.ArgumentParser(prog="python -m tests.fuzz", description=__doc__)
    parser.add_argument("files", nargs="*", type=Path, help="further recordings to try")
    parser.add_argument(
        "--of", nargs="*", type=Path, default=[], help="further recordings to make mutants of"
    )
    parser.add_argument("--count", type=int, default=5000, help="mutants (default 5000)")
    parser.add_argument("--seed", type=int, default=0, help="of the mutants (default 0)")
    parser.add_argument("--keep", type=Path, default=Path("fuzz"), help="folder for faulty files")
    options = parser.parse_args()
    resource.setrlimit(resource.RLIMIT_AS, (_MOST_MEMORY, _MOST_MEMORY))
    counts: collections.Counter[str] = collections.Counter()
    slowest, largest, began = 0.0, 0, time.monotonic()
    with TemporaryDirectory() as folder:
        for path in _files(Path(folder), options):
            outcome = _timed(tried(path))
            kind = "fault" if outcome.faults else "refused" if outcome.refusal else "opened"
            counts[kind] += 1
            slowest, largest = max(slowest, outcome.seconds), max(largest, outcome.memory)
            if outcome.faults:
                print(f"{path.name}: {'; '.join(outcome.faults)}", flush=True)
                options.keep.mkdir(exist_ok=True)
                (options.keep / path.name).write_bytes(path.read_bytes())
            if path.parent == Path(folder):
                path.unlink()
    print(
        f"{counts.total()} files in {time.monotonic() - began:.0f} s: {counts['opened']} opened, "
        f"{counts['refused']} refused in a sentence, {counts['fault']} with faults; slowest "
        f"{slowest:.1f} s of CPU, largest memory {largest / 1e6:.0f} MB"
    )
    return 1 if counts["fault"] else 0


def _files(folder: Path, options: argparse.Namespace) -> Iterator[Path]:
    yield from options.files
    for name, handmade in HANDMADE.items():
        yield handmade.write(folder / f"{name}.mcap")
    good = [*seeds().items(), *((path.stem, path.read_bytes()) for path in options.of)]
    for number in range(options.count):
        name, content = good[number % len(good)]
        path = folder / f"{name}_{options.seed}_{number}.mcap"
        path.write_bytes(mutant(content, np.random.default_rng([options.seed, number])))
        yield path


def _timed(outcome: Outcome) -> Outcome:
    """The outcome, with a fault where it took too long."""
    if outcome.seconds <= CPU_SECONDS:
        return outcome
    return replace(outcome, faults=(*outcome.faults, f"it took {outcome.seconds:.1f} s of CPU"))


if __name__ == "__main__":
    sys.exit(main())
