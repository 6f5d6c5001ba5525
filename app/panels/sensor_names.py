"""Names of sensors below their images, and the groups whose images stand in rows of their own."""

import re
from collections.abc import Sequence

_LONGEST = 8  # characters below an image
_LARGEST = 16  # sensors in a row
_GROUP = re.compile(r"(.*[^0-9/_-])[/_-]*([0-9]+)")


def groups(names: Sequence[str]) -> list[tuple[str, list[int]]]:
    """Sensors by what their names say before a number, such as "base" and "elbow".

    What is out of line is seen among neighbours: an image that stands on its head, or has what
    moves where the sensors beside it have not.

    Args:
        names: of all sensors.

    Returns:
        (name, indices) of each group in the order of the sensors; one group with the name ""
        where names do not make at least two groups that fit into rows.
    """
    found: dict[str, list[int]] = {}
    for index, name in enumerate(names):
        match = _GROUP.fullmatch(name)
        if match is None:
            return [("", list(range(len(names))))]
        found.setdefault(match[1], []).append(index)
    sizes = [len(members) for members in found.values()]
    if len(found) < 2 or min(sizes) < 2 or max(sizes) > _LARGEST:
        return [("", list(range(len(names))))]
    return list(found.items())


def captions(names: Sequence[str]) -> list[str]:
    """What is written below each image: the number alone where a row says the rest."""
    if len(groups(names)) > 1:
        return [match[2] for name in names if (match := _GROUP.fullmatch(name))]
    return short_names(names)


def short_names(names: Sequence[str]) -> list[str]:
    """Names that fit below an image: without what all begin with, long words as initials.

    Names stay whole where that would make two of them the same.
    """
    if len(names) < 2:
        return list(names)
    first, last = min(names), max(names)
    same = next((i for i, c in enumerate(first) if i >= len(last) or last[i] != c), len(first))
    start = max(first.rfind("/", 0, same), first.rfind("_", 0, same)) + 1
    short = [name[start:] for name in names]
    for i, name in enumerate(short):
        if len(name) > _LONGEST:
            parts = (part.split("_") for part in name.split("/"))
            short[i] = "/".join("".join(w if w.isdigit() else w[:1] for w in p) for p in parts)
    return short if len(set(short)) == len(set(names)) else list(names)
