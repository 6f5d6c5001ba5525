"""Running of a subcommand: parser, log, and errors in one sentence."""

import argparse
import io
import logging
import os
import sys
from collections.abc import Sequence
from importlib import import_module
from typing import Any, NoReturn

from app.commands.signals import ending_at_once

SUBCOMMANDS = {
    "view": "look at recordings and tune the estimator in the browser",
    "info": "what is in a recording",
    "simulate": "make simulated recordings",
    "evaluate": "errors against the truth",
    "study": "the paper's tables and its figure of n, made again",
    "export": "make a picture, a video, an offline page, plots or a table of a recording",
}
"""{subcommand, and its module in `app.commands`: its help}; only the one asked for is imported."""
_LOG = logging.getLogger(__name__)
_OURS = ("app", "estimator", "recordings", "robot_assets")
_LOG_LEVELS = ("debug", "info", "warning", "error", "critical")


class _Parser(argparse.ArgumentParser):
    """Parser whose errors are one sentence, and whose flags are written in full."""

    def __init__(self, **options: Any) -> None:  # noqa: ANN401 (argparse's)
        super().__init__(allow_abbrev=False, **options)

    def error(self, message: str) -> NoReturn:
        """Say what is wrong in one sentence, without the usage in front of it."""
        from robot_assets.printable import printable

        print(f"{self.prog}: {printable(message)}; see '{self.prog} --help'.", file=sys.stderr)
        raise SystemExit(2)


class LogFormatter(logging.Formatter):
    """Format of log lines in which control characters are escapes: names come from files."""

    def format(self, record: logging.LogRecord) -> str:
        """The lines of a record, a traceback's included."""
        from robot_assets.printable import printable

        return "\n".join(map(printable, super().format(record).split("\n")))


def run(arguments: Sequence[str]) -> int:
    """Run a subcommand with its arguments, and return its exit code."""
    if isinstance(sys.stdout, io.TextIOWrapper):
        # Whatever the language of the terminal is: what it does not have is an escape.
        sys.stdout.reconfigure(errors="backslashreplace")
    try:
        try:
            return _run(arguments)
        finally:
            if sys.stdout is not None:
                sys.stdout.flush()
    except BrokenPipeError:
        # The reader of a pipe has gone: that is its right, and no error of ours.
        _discard_output()
        return 0
    except OSError as error:
        _discard_output()
        print(f"tofscope: standard output cannot be written: {error.strerror}.", file=sys.stderr)
        return 1


def _run(arguments: Sequence[str]) -> int:
    parser, subparsers = _parsers()
    name = next((text for text in arguments if not text.startswith("-")), None)
    if name in subparsers:
        return _run_subcommand(name, subparsers[name], parser, arguments)
    parser.parse_args(arguments)  # it tells the help, or what is wrong, and ends
    parser.exit()


def _run_subcommand(
    name: str, subparser: argparse.ArgumentParser, parser: _Parser, arguments: Sequence[str]
) -> int:
    with ending_at_once():
        from app.commands.flags.parameter_flags import register_method_files
        from app.errors import UserError
        from robot_assets.printable import printable

        module = import_module(f"app.commands.{name}")
    try:
        register_method_files(arguments)
        module.add_flags(subparser)
        _add_log_level(subparser)
    except UserError as error:
        print(f"tofscope: {printable(str(error))}", file=sys.stderr)
        return 2
    options = parser.parse_args(arguments)
    _set_up_log(options.log_level)
    try:
        return module.run(options)
    except UserError as error:
        print(f"tofscope {name}: {printable(str(error))}", file=sys.stderr)
        return 1
    except Exception as error:
        # Errors of files have their name, and are sentences already: this is standard output's.
        if isinstance(error, OSError) and error.filename is None:
            raise
        _LOG.exception("Unexpected error.")
        said = printable(f"{type(error).__name__}: {error}")
        print(
            f"tofscope {name}: something unexpected went wrong ({said}); please report "
            "it with the lines above.",
            file=sys.stderr,
        )
        return 1


def _discard_output() -> None:
    """Write to nowhere what is left for standard output, at the interpreter's end, too."""
    os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())


def _parsers() -> tuple[_Parser, dict[str, argparse.ArgumentParser]]:
    """Parser of the command, and {name: parser} of its subcommands, without their own flags."""
    parser = _Parser(
        prog="tofscope",
        description="See and tune scene flow from miniature time-of-flight sensors.",
    )
    commands = parser.add_subparsers(dest="command", required=True, metavar="COMMAND")
    return parser, {name: commands.add_parser(name, help=SUBCOMMANDS[name]) for name in SUBCOMMANDS}


def _add_log_level(parser: argparse.ArgumentParser) -> None:
    parser.add_argument(
        "--log-level",
        type=str.lower,
        choices=_LOG_LEVELS,
        default="warning",
        help="least severe messages that are logged on standard error (default warning)",
    )


def _set_up_log(level: str) -> None:
    """Log on standard error: our own messages from a level on, warnings of libraries."""
    handler = logging.StreamHandler(sys.stderr)
    handler.setFormatter(LogFormatter("%(asctime)s %(levelname)s %(name)s: %(message)s"))
    logging.basicConfig(handlers=[handler])
    for package in _OURS:
        logging.getLogger(package).setLevel(level.upper())
