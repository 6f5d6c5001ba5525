"""Names of a recording's sensors, by their topics."""

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
    """Name sensors, and their rings, like a rig's, or else by their topics.

    Where several topics match one sensor of a rig, its name says nothing, and that of the next rig
    or of the topic counts.

    Args:
        topics: of the depth images.
        in_rigs: for each rig, the one that counts most first, the sensor of it that each topic
            matches, None without.

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
    """The sensors, None for those whose name another has, too."""
    having = Counter(sensor.name for sensor in sensors if sensor)
    return [sensor if sensor and having[sensor.name] == 1 else None for sensor in sensors]


def sensor_names(topics: Sequence[str], taken: Collection[str] = ()) -> list[str]:
    """Name sensors by the shortest tails of their topics that tell them, and their rings, apart.

    The last part of a topic says what is in it ("image"), and is left out unless it is all that
    tells two sensors apart. All tails have the same number of parts where the topics have so many.

    Args:
        topics: of the depth images, such as "/left/tof/base/0/image".
        taken: names that other sensors have.

    Returns:
        A name for each topic, such as "base/0"; no two are equal, and none is in `taken`.
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
    """The ring of a sensor by its name: "base" of "base/0", "" where the name is no such one."""
    ring, _, number = name.rpartition("/")
    return ring if number.isdigit() else ""


def _rings_apart(stems: Sequence[_Path], tails: Sequence[_Path]) -> bool:
    """Whether sensors with different rings in their whole paths have them in the tails, too."""
    rings = {
        (tail[:-1], stem[:-1])
        for stem, tail in zip(stems, tails, strict=True)
        if ring_of("/".join(tail))
    }
    return len({tail for tail, _ in rings}) == len(rings)


def _numbered(names: Iterable[str], taken: Collection[str]) -> list[str]:
    """The names, with a number behind those that are in use already."""
    # The same topic may be there with two types, and "/tof//0" beside "/tof/0".
    used = set(taken)
    result: list[str] = []
    for name in (name or _NAMELESS for name in names):
        options = chain([name], (f"{name} ({number})" for number in count(2)))
        result.append(next(option for option in options if option not in used))
        used.add(result[-1])
    return result
