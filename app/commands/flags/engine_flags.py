"""The --engine flag: what computes clusters and registrations."""

import argparse
import sys

from app.commands.signals import ending_at_once
from estimator import ENGINES, use_engine


def add_engine_flag(parser: argparse.ArgumentParser) -> None:
    """Add --engine."""
    parser.add_argument(
        "--engine",
        choices=list(ENGINES),
        default=next(iter(ENGINES)),
        help=(
            "compiled (default): the same on every machine, and several times as fast; reference: "
            "scikit-learn and Open3D themselves, whose choice between equal distances depends on "
            "the processor"
        ),
    )


def choose_engine(name: str) -> None:
    """Use an engine in this process, and compile it first where that is due."""
    engine = ENGINES[name]
    use_engine(engine)
    if engine.name != "compiled":
        return
    from estimator.engine.readiness import compile_all, is_compiled

    if not is_compiled():
        print("Compiling the estimator, once, in about half a minute.", file=sys.stderr)
    # The compiler would swallow a KeyboardInterrupt.
    with ending_at_once():
        compile_all()
