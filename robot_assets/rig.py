"""Rig: the sensors of a robot with their extrinsics, read from a TOML file."""

import math
import tomllib
from collections.abc import Sequence
from dataclasses import dataclass
from importlib.resources import files
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from robot_assets.sensor_model import SensorModel, unit
from robot_assets.table import Table, TableError

_MOST_SENSORS = 1000


class RigError(Exception):
    """Rig file that cannot be used; the message names the file and the key."""


@dataclass(frozen=True)
class Sensor:
    """One sensor of a rig.

    Attributes:
        name: unique in the rig, such as "elbow/3".
        ring: name of its ring, "" for a single sensor.
        link: the link it is fixed to.
        T_link_sensor: (4, 4), takes points of its optical frame into the link's.
    """

    name: str
    ring: str
    link: str
    T_link_sensor: NDArray[np.float64]


@dataclass(frozen=True)
class Rig:
    """The sensors of a robot.

    Attributes:
        name: shown on screen.
        model: of all its sensors.
        sensors: in the order of the file, rings first.
    """

    name: str
    model: SensorModel
    sensors: tuple[Sensor, ...]

    def check_links(self, links: tuple[str, ...], robot: str) -> None:
        """Raise RigError where a sensor is fixed to a link that the robot does not have."""
        for sensor in self.sensors:
            if sensor.link not in links:
                raise RigError(
                    f"The rig '{self.name}' fixes sensor {sensor.name} to link {sensor.link}, "
                    f"which the robot {robot} has not; it has {', '.join(links)}."
                )


def load_rig(path: str | Path | None = None) -> Rig:
    """Load a rig from a TOML file; None is the paper's rig of 24 sensors on a Panda.

    Raises:
        RigError: the file is not there or not TOML, or a key is missing, unknown or wrong.
    """
    where = Path(path) if path is not None else Path(str(files("robot_assets") / "rigs/paper.toml"))
    try:
        content = where.read_bytes()
    except OSError as error:
        raise RigError(f"{where} cannot be read as a rig file: {error.strerror}.") from error
    return parse_rig(content, str(where))


def parse_rig(content: bytes, where: str) -> Rig:
    """Read a rig from the bytes of a TOML file; `where` names their origin in messages.

    Raises:
        RigError: as in `load_rig`.
    """
    try:
        table = tomllib.loads(content.decode("utf-8"))
    except (ValueError, RecursionError) as error:  # also a number of too many digits
        raise RigError(f"{where} is not a TOML file: {error}.") from error
    try:
        return _rig(Table(table))
    except TableError as error:
        raise RigError(f"{where}: {error}") from error


def _rig(table: Table) -> Rig:
    name = table.text("name")
    model = _sensor_model(table.table("sensor_model"))
    sensors: list[Sensor] = []
    for ring in table.tables("rings"):
        sensors += _ring(ring)
        if len(sensors) > _MOST_SENSORS:
            break
    for single in table.tables("sensors"):
        sensors.append(_single(single))
    table.finish()
    if not sensors:
        raise TableError("there must be at least one of [[rings]] and [[sensors]], found none.")
    if len(sensors) > _MOST_SENSORS:
        raise TableError(f"there must be at most {_MOST_SENSORS} sensors, found more.")
    _check_names([sensor.name for sensor in sensors])
    return Rig(name, model, tuple(sensors))


def _check_names(names: Sequence[str]) -> None:
    """Names are told apart in topics and frames, where only letters and digits are the same."""
    seen: dict[str, str] = {}
    for name in names:
        plain = plain_name(name)
        if not plain:
            raise TableError(f"the name {name!r} of a sensor must have a letter or a digit.")
        if seen.get(plain) == name:
            raise TableError(f"two sensors have the name {name!r}; names must be unique.")
        if plain in seen:
            raise TableError(
                f"the names {seen[plain]!r} and {name!r} must differ in letters or digits, by "
                f"which sensors are told apart."
            )
        seen[plain] = name


def plain_name(text: str) -> str:
    """A name, topic or frame by which sensors are matched: small letters, digits, underscores."""
    return "_".join("".join(c if c.isalnum() else " " for c in text.lower()).split())


def _sensor_model(table: Table) -> SensorModel:
    min_range = table.number("min_range_m", low=0.0, high=100.0)
    across, down = table.number_or_two("field_of_view_deg", low=1.0, high=170.0)
    model = SensorModel(
        name=table.text("name"),
        rows=table.integer("rows", low=2, high=64),
        columns=table.integer("columns", low=2, high=64),
        field_of_view=math.radians(across),
        vertical_field_of_view=None if down is None else math.radians(down),
        min_range=min_range,
        max_range=table.number("max_range_m", low=max(min_range, 0.001), high=100.0),
        distance=table.choice("distance", ("perpendicular", "radial")),  # type: ignore[arg-type]
        reading_order=table.choice("reading_order", ("row_major", "column_major")),  # type: ignore[arg-type]
        flip_vertical=table.boolean("flip_vertical"),
        flip_horizontal=table.boolean("flip_horizontal"),
    )
    table.finish()
    return model


def _ring(table: Table) -> list[Sensor]:
    name, link = table.text("name"), table.text("link")
    count = table.integer("count", low=1, high=1000)
    radius = table.number("radius_m", low=0.0, high=10.0)
    centre = table.vector("centre_m")
    axis = unit(table.vector("axis", nonzero=True))
    first = table.direction_across("first_direction", axis)
    table.finish()
    side = np.cross(axis, first)
    sensors: list[Sensor] = []
    for i, angle in enumerate(2 * np.pi * np.arange(count) / count):
        outward = np.cos(angle) * first + np.sin(angle) * side
        pose = look(centre + radius * outward, outward, axis)
        sensors.append(Sensor(f"{name}/{i}", name, link, pose))
    return sensors


def _single(table: Table) -> Sensor:
    name, link, ring = table.text("name"), table.text("link"), table.text("ring", otherwise="")
    position = table.vector("position_m")
    forward = unit(table.vector("forward", nonzero=True))
    up = table.direction_across("up", forward)
    table.finish()
    return Sensor(name, ring, link, look(position, forward, up))


def look(
    position: NDArray[np.float64], forward: NDArray[np.float64], up: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Pose (4, 4) of an optical frame at `position`, z along `forward`, y opposite to `up`.

    `forward` and `up` are perpendicular unit vectors.
    """
    pose: NDArray[np.float64] = np.eye(4)
    pose[:3, 0] = np.cross(forward, up)
    pose[:3, 1] = -up
    pose[:3, 2] = forward
    pose[:3, 3] = position
    return pose
