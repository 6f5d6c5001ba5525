"""The page that viser ships, unpacked."""

import re
from functools import cache
from pathlib import Path

import viser
import zstandard

PAGE = Path(viser.__file__).parent / "client" / "build" / "index.html"
_DIGITS = {c: i for i, c in enumerate(c for c in map(chr, range(0x21, 0x7F)) if c not in "\"&<>'`")}


@cache
def page() -> str:
    """Its HTML as it is sent."""
    return PAGE.read_text("utf-8")


@cache
def scripts_and_styles() -> str:
    """Its style sheet and its script: one zstd frame in base 88, five letters to four bytes."""
    found = re.search(r'data-p="([^"]+)"', page())
    assert found, f"viser packs {PAGE} in another way: unpack it so here, too"
    packed = found[1]
    groups = [packed[i : i + 5] for i in range(0, len(packed), 5)]
    data = b"".join(_number(g).to_bytes(4, "big")[-len(g) + 1 :] for g in groups)
    return zstandard.ZstdDecompressor().decompress(data, max_output_size=1 << 26).decode()


def _number(letters: str) -> int:
    value = 0
    for letter in letters:
        value = 88 * value + _DIGITS[letter]
    return value
