"""`tofscope study`: the paper's tables and its sweep of n, simulated or on recordings."""

import argparse
import os
from pathlib import Path
from typing import Any

from app.errors import InputError
from app.parameter_flags import add_parameter_flags, parameters_from
from app.study.execution import outcomes
from app.study.paper_tables import table_1, table_2
from app.study.plan import PAPER_SCENARIOS, SWEEP, Plan
from app.study.progress import Progress
from app.study.rows import rows_of
from app.study.software import software_digest
from app.study.store import Store
from app.study.text_files import as_markdown
from estimator import method_names
from recordings.simulation import NOISE_MODELS, SCENARIOS, SPEEDS, TRIALS


def add_parser(commands: Any) -> None:  # noqa: ANN401 (argparse does not export the type)
    """Add the subcommand."""
    parser = commands.add_parser("study", help="the paper's tables and figure, made again")
    parser.add_argument("--out", type=Path, required=True, metavar="FOLDER")
    parser.add_argument("--method", nargs="+", choices=method_names(), dest="methods")
    parser.add_argument("--scenario", nargs="+", choices=list(SCENARIOS), default=PAPER_SCENARIOS)
    parser.add_argument("--speed", nargs="+", type=float, default=SPEEDS)
    parser.add_argument("--trial", nargs="+", type=int, default=TRIALS)
    parser.add_argument("--sweep", nargs="*", type=int, default=SWEEP, metavar="N")
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--noise", choices=list(NOISE_MODELS), default="paper")
    parser.add_argument("--jobs", type=int, default=os.cpu_count() or 1)
    parser.add_argument("--dask", metavar="ADDRESS")
    add_parameter_flags(parser, leave_out=("method",))
    parser.set_defaults(run=run)


def run(options: argparse.Namespace) -> int:
    """Run the subcommand."""
    plan = Plan(
        parameters_from(options),
        methods=tuple(options.methods or ("paper", "baseline")),
        scenarios=tuple(options.scenario),
        speeds=tuple(options.speed),
        trials=tuple(options.trial),
        sweep=tuple(options.sweep),
        seed=options.seed,
        noise=options.noise,
    )
    if options.jobs < 1:
        raise InputError(f"--jobs must be 1 or more, got {options.jobs}.")
    store = Store(options.out / "results", software_digest())
    works = plan.works()
    left = [work for work in map(store.missing, works) if work]
    progress = Progress(len(works), len(works) - len(left))
    failures: list[str] = []
    for outcome in outcomes(left, options.jobs, options.dask):
        store.keep(outcome)
        if outcome.failure:
            failures.append(outcome.failure)
        progress.advance(outcome.source.name)
    progress.close()
    rows = rows_of(outcome for work in works if (outcome := store.finished(work)))
    for table in (table_1(plan, rows), table_2(plan, rows)):
        text = as_markdown(table)
        (options.out / f"{table.name}.md").write_text(text, encoding="utf-8")
        print(text)
    return 0 if rows else 1
