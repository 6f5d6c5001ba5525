"""Completion of a server's answers: headers of all, and a page in place of the one it sends."""

import functools
import gzip
from collections.abc import Callable, Mapping

from websockets.asyncio.server import ServerConnection
from websockets.http11 import Request, Response

Page = Callable[[bytes], bytes]


def completing(
    headers: Mapping[str, str], page: Page
) -> Callable[[ServerConnection, Request, Response], None]:
    """Function that completes answers.

    Args:
        headers: of all answers.
        page: changes HTML.
    """
    # Servers keep what they send: two answers in all, plain and compressed.
    changed = functools.lru_cache(maxsize=4)(functools.partial(_changed, page))

    def complete(_: ServerConnection, __: Request, response: Response) -> None:
        if response.headers.get("Content-Type", "").startswith("text/html"):
            zipped = response.headers.get("Content-Encoding") == "gzip"
            response.body = changed(bytes(response.body), zipped)
            del response.headers["Content-Length"]
            response.headers["Content-Length"] = str(len(response.body))
        for name, value in headers.items():
            response.headers[name] = value

    return complete


def _changed(page: Page, html: bytes, zipped: bool) -> bytes:
    """A changed page, compressed as it was."""
    return gzip.compress(page(gzip.decompress(html))) if zipped else page(html)
