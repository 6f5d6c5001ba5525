"""Names of a recording's sensors, from rigs or topics."""

from collections import Counter
from collections.abc import Collection, Iterable, Sequence
from itertools import chain, count

from robot_assets import Sensor

_SHORTEST = 2  # parts of a topic: a ring and a number, where there are these
_NAMELESS = "sensor"

_Path = tuple[str, ...]


def names_and_rings(
    topics: Sequence[str], *in_rigs: Sequence[Sensor | None]
) -> list[tuple[str, str]]:
    """Name sensors and their rings as in a rig, or else by their topics.

    Where several topics match one sensor of a rig, its name is ambiguous, and the next rig or the
    topic is used.

    Args:
        topics: of the depth images.
        in_rigs: for each rig, in order of preference, the sensor that each topic matches, None
            without.

    Returns:
        (name, ring) for each topic, ring "" where it has none; names are unique.
    """
    named: list[Sensor | None] = [None] * len(topics)
    for in_rig in in_rigs:
        named = _one_each([a or b for a, b in zip(named, in_rig, strict=True)])
    others = [topic for topic, sensor in zip(topics, named, strict=True) if not sensor]
    by_topic = iter(sensor_names(others, [sensor.name for sensor in named if sensor]))
    return [
        (sensor.name, sensor.ring) if sensor else (name := next(by_topic), ring_of(name))
        for sensor in named
    ]


def _one_each(sensors: Sequence[Sensor | None]) -> list[Sensor | None]:
    """Replace sensors whose name is not unique by None."""
    having = Counter(sensor.name for sensor in sensors if sensor)
    return [sensor if sensor and having[sensor.name] == 1 else None for sensor in sensors]


def sensor_names(topics: Sequence[str], taken: Collection[str] = ()) -> list[str]:
    """Name sensors by the shortest ends of their topics that distinguish them and their rings.

    The last part of a topic is its content ("image"), and is left out unless sensors differ only
    there. All names have the same number of parts, as far as the topics have them.

    Args:
        topics: of the depth images, such as "/left/tof/base/0/image".
        taken: names of other sensors.

    Returns:
        A name for each topic, such as "base/0"; names are unique, and none is in `taken`.
    """
    paths = [tuple(part for part in topic.split("/") if part.strip()) for topic in topics]
    above = [path[:-1] or path for path in paths]
    for stems in (above, paths):
        for length in range(_SHORTEST, max([_SHORTEST, *map(len, stems)]) + 1):
            tails = [stem[-length:] for stem in stems]
            names = ["/".join(tail) for tail in tails]
            distinct = len(set(names)) == len(names) and set(names).isdisjoint(taken)
            if distinct and _rings_apart(stems, tails):
                return _numbered(names, taken)
    return _numbered(["/".join(path) for path in paths], taken)


def ring_of(name: str) -> str:
    """Ring of a sensor by its name: "base" of "base/0", "" where the name has no number."""
    ring, _, number = name.rpartition("/")
    return ring if number.isdigit() else ""


def _rings_apart(stems: Sequence[_Path], tails: Sequence[_Path]) -> bool:
    """Whether sensors whose rings differ in the whole paths have different rings in the tails."""
    rings = {
        (tail[:-1], stem[:-1])
        for stem, tail in zip(stems, tails, strict=True)
        if ring_of("/".join(tail))
    }
    return len({tail for tail, _ in rings}) == len(rings)


def _numbered(names: Iterable[str], taken: Collection[str]) -> list[str]:
    """Make names unique by a number at the end."""
    # A topic may exist with two types, and "/tof//0" beside "/tof/0".
    used = set(taken)
    result: list[str] = []
    for name in (name or _NAMELESS for name in names):
        options = chain([name], (f"{name} ({number})" for number in count(2)))
        result.append(next(option for option in options if option not in used))
        used.add(result[-1])
    return result
