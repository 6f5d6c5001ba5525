"""`tofscope view`: the app in the browser."""

import argparse
import ipaddress
import re
import sys
import threading
from contextlib import ExitStack, suppress
from pathlib import Path
from typing import TYPE_CHECKING

from app.commands.flags.engine_flags import add_engine_flag
from app.commands.flags.parameter_flags import add_parameter_flags, parameters_from
from app.commands.flags.recording_flags import add_recording_flags, opening_from
from app.commands.signals import ending_at_once, handled
from estimator import ENGINES
from recordings import sample_paths
from robot_assets.printable import printable

if TYPE_CHECKING:
    from app.analysis.library import Library

_LOOK_UP = 0.5  # seconds
# A host is a name, an IPv4 address, or an IPv6 address in brackets; what else stands there could
# end the header that the origin is put into, or allow more than one origin.
_ORIGIN = re.compile(r"https?://(?:[a-z0-9_-]+(?:\.[a-z0-9_-]+)*|\[[0-9a-f:.]+\])(?::\d{1,5})?")


def add_flags(parser: argparse.ArgumentParser) -> None:
    """Describe the subcommand, and add its flags."""
    parser.description = "Serve a page that shows recordings and their scene flow. Ctrl-C ends it."
    parser.add_argument(
        "paths",
        nargs="*",
        type=Path,
        metavar="PATH",
        help=(
            "a recording, several, or a folder of them (*.mcap, also in the folders below); "
            "default: the shipped samples"
        ),
    )
    parser.add_argument(
        "--host",
        default="127.0.0.1",
        help="address to serve at (default 127.0.0.1: for this machine alone)",
    )
    parser.add_argument(
        "--port", type=_port, default=8080, help="port to serve at, 0 for a free one (default 8080)"
    )
    parser.add_argument(
        "--embed-in",
        action="append",
        default=[],
        type=_origin,
        metavar="ORIGIN",
        help=(
            "let pages of this origin, such as https://lab.example, show the app in a frame; may "
            "be given several times (default: no page may)"
        ),
    )
    add_recording_flags(parser)
    add_engine_flag(parser)
    add_parameter_flags(parser)


def run(options: argparse.Namespace) -> int:
    """Serve until a signal ends it."""
    # viser takes a second to import, which `tofscope --help` need not wait for.
    with ending_at_once():
        from app.analysis.engine_switch import EngineSwitch
        from app.analysis.estimates import Estimates
        from app.analysis.library import Library
        from app.server.memory_release import keep_together
        from app.server.server import Server
        from app.server.session import Shared
        from app.session.reload import Reloads

        keep_together()
        parameters = parameters_from(options)
        library = Library(options.paths or sample_paths(), opening_from(options).open)
        entries = library.listing()
        if len(entries) == 1:
            # The only recording there is must open; of several, a bad one is told on the page.
            library.release(library.open(entries[0]).entry)

    ended, engine = threading.Event(), EngineSwitch()
    shared = Shared(library, Estimates(), Reloads(), parameters, engine)
    engine.begin(ENGINES[options.engine])
    with handled(lambda *_: ended.set()):
        server = Server(shared, options.host, options.port, options.embed_in)
        try:
            if not _is_loopback(options.host):
                said = _warning(options.host, server.address_for_others)
                print(printable(said), file=sys.stderr)
            print(printable(f"Tofscope is at {server.address}"), flush=True)
            threading.Thread(target=_prepare, args=(library,), name="warm-up", daemon=True).start()
            # A signal may reach a thread of some library: the main thread, which alone runs its
            # handler, is not woken by it and has to look up by itself.
            while not ended.wait(_LOOK_UP):
                pass
        finally:
            engine.close()
            server.close()
    return 0


def _prepare(library: "Library") -> None:
    """Do what the first page needs and a browser is not there for yet, in the order of its needs.

    The first recording stays open meanwhile, so that a session shares it.
    """
    from app.analysis.estimates import warm_up
    from app.scene.shapes import robot_shape
    from app.server.memory_release import trim

    first = next(iter(library.listing()), None)
    with ExitStack() as opened:
        with suppress(Exception):  # the session that meets it again tells of it
            if first:
                recording = library.open(first).recording
                opened.callback(library.release, first)
                if recording.robot:
                    robot_shape(recording.robot)
        warm_up()
    trim()  # what the imports and the first drawing have left


def _warning(host: str, address: str) -> str:
    return (
        f"Warning: at {host} everybody who can reach this machine can see the recordings, and "
        "change and delete the presets. There is no password, and nothing is encrypted. Others "
        f"find the page at {address}."
    )


def _is_loopback(host: str) -> bool:
    try:
        return ipaddress.ip_address(host).is_loopback
    except ValueError:
        return host == "localhost"


def _port(text: str) -> int:
    if not text.isdecimal() or int(text) > 65535:
        raise argparse.ArgumentTypeError(f"a port is a number from 0 to 65535, got {text!r}")
    return int(text)


def _origin(text: str) -> str:
    origin = text.lower().removesuffix("/")
    if not _ORIGIN.fullmatch(origin):
        raise argparse.ArgumentTypeError(
            "an origin is http:// or https:// and a host, with a port where it has one, such as "
            f"https://lab.example or http://localhost:8888, got {text!r}"
        )
    return origin
