"""Rig: the sensors of a robot with their extrinsics, read from a TOML file."""

import math
import tomllib
from dataclasses import dataclass
from importlib.resources import files
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from pydantic import ValidationError

from robot_assets.errors import SentenceError
from robot_assets.input_files import read_file
from robot_assets.rig_file import RigFile, RingTable, SensorModelTable, SingleTable
from robot_assets.rig_problems import problems
from robot_assets.sensor_model import SensorModel, unit

_LARGEST = 1_000_000  # bytes; a thousand sensors need a third of it


class RigError(SentenceError):
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
                    f"which the robot {robot} does not have; it has {', '.join(links)}."
                )


def load_rig(path: str | Path | None = None) -> Rig:
    """Load a rig from a TOML file; None is the paper's rig of 24 sensors on a Panda.

    Raises:
        RigError: the file is not there, too large or not TOML, or a key is missing, unknown or
            wrong; the sentence names the first three of several.
    """
    where = Path(path) if path is not None else Path(str(files("robot_assets") / "rigs/paper.toml"))
    return parse_rig(read_file(where, _LARGEST, "rig", RigError), str(where))


def parse_rig(content: bytes, where: str) -> Rig:
    """Read a rig from the bytes of a TOML file; `where` names their origin in messages.

    Raises:
        RigError: as in `load_rig`.
    """
    try:
        table = tomllib.loads(content.decode("utf-8-sig"))
    except UnicodeDecodeError as error:
        raise RigError(f"{where} is not a text file, so it cannot be a rig file.") from error
    except tomllib.TOMLDecodeError as error:
        raise RigError(f"{where} is not a TOML file: {error}.") from error
    except RecursionError as error:
        raise RigError(f"{where} has too deeply nested lists or tables.") from error
    except ValueError as error:  # Python reads no more than 4300 digits
        raise RigError(
            f"{where} holds a number of thousands of digits; give a smaller one."
        ) from error
    try:
        return _rig(RigFile.model_validate(table))
    except ValidationError as error:
        raise RigError(f"{where}: {problems(error)}") from error


def _rig(content: RigFile) -> Rig:
    sensors = [sensor for ring in content.rings for sensor in _ring(ring)]
    sensors += [_single(single) for single in content.sensors]
    return Rig(content.name, _sensor_model(content.sensor_model), tuple(sensors))


def _sensor_model(table: SensorModelTable) -> SensorModel:
    angles = table.field_of_view_deg
    across, *down = angles if isinstance(angles, list) else [angles]
    return SensorModel(
        name=table.name,
        rows=table.rows,
        columns=table.columns,
        field_of_view=math.radians(across),
        vertical_field_of_view=math.radians(down[0]) if down else None,
        min_range=table.min_range_m,
        max_range=table.max_range_m,
        distance=table.distance,
        reading_order=table.reading_order,
        flip_vertical=table.flip_vertical,
        flip_horizontal=table.flip_horizontal,
    )


def _ring(table: RingTable) -> list[Sensor]:
    axis = unit(np.array(table.axis))
    first = _across(table.first_direction, axis)
    side = np.cross(axis, first)
    sensors: list[Sensor] = []
    angles = 2 * np.pi * np.arange(table.count) / table.count
    for name, angle in zip(table.sensor_names, angles, strict=True):
        outward = np.cos(angle) * first + np.sin(angle) * side
        pose = look(np.array(table.centre_m) + table.radius_m * outward, outward, axis)
        sensors.append(Sensor(name, table.name, table.link, pose))
    return sensors


def _single(table: SingleTable) -> Sensor:
    forward = unit(np.array(table.forward))
    pose = look(np.array(table.position_m), forward, _across(table.up, forward))
    return Sensor(table.name, table.ring or "", table.link, pose)


def _across(direction: list[float], axis: NDArray[np.float64]) -> NDArray[np.float64]:
    """Component of a direction perpendicular to the unit vector `axis`, as a unit vector."""
    vector = np.array(direction)
    return unit(vector - (vector @ axis) * axis)


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
