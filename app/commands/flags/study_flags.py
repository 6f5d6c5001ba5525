"""The flags of `tofscope study` that say what is studied."""

import argparse
from pathlib import Path

from app.commands.flags.simulation_flags import ALL, MAX_SPEED, MORE
from app.study.plan import ABLATION_SPEED
from recordings.simulation import IMPERFECTIONS, NOISE_MODELS, PAPER_SCENARIOS, SCENARIOS


def add_source_flags(parser: argparse.ArgumentParser) -> None:
    """Add --recordings, and the flags of the simulation that replaces them."""
    group = parser.add_argument_group("what is studied")
    group.add_argument(
        "--recordings",
        nargs="+",
        type=Path,
        metavar="PATH",
        help=(
            "recordings or folders that are taken instead of simulated ones; those that say a "
            "scenario of the paper, speed and trial enter its tables, every one gets its own line"
        ),
    )
    # Only given flags are set: with --recordings none of them is allowed.
    unset = argparse.SUPPRESS
    group.add_argument(
        "--scenario",
        nargs="+",
        choices=[*SCENARIOS, ALL, MORE],
        default=unset,
        metavar="SCENARIO",
        help=(
            f"scenarios to simulate, see tofscope simulate: {', '.join(SCENARIOS)}; {ALL} (the "
            f"default): the paper's {', '.join(PAPER_SCENARIOS)}; {MORE}: the others"
        ),
    )
    group.add_argument(
        "--speed",
        nargs="+",
        type=float,
        default=unset,
        metavar="M/S",
        help=f"up to {MAX_SPEED:g} m/s (default each scenario's)",
    )
    group.add_argument(
        "--trial", nargs="+", type=int, default=unset, metavar="NUMBER", help="default 1 to 5"
    )
    group.add_argument(
        "--seed", type=int, default=unset, help="seed of all random numbers (default 0)"
    )
    group.add_argument(
        "--noise",
        choices=list(NOISE_MODELS),
        default=unset,
        help="the sensors' errors, see tofscope simulate (default paper)",
    )
    group.add_argument(
        "--imperfections",
        nargs="+",
        choices=list(IMPERFECTIONS),
        default=unset,
        help="what else is wrong, see tofscope simulate (default nothing)",
    )
    group.add_argument(
        "--ablation",
        action="store_true",
        default=unset,
        help=(
            "a further table: what every noise model and every imperfection does to the errors, "
            f"at {ABLATION_SPEED:g} m/s"
        ),
    )
