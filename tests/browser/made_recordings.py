"""Small recordings of which a test knows every number."""

from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from tests.recordings.foreign import ForeignFile, at, camera_info, image, transforms, twist

FRAMES, PERIOD = 30, 0.4
"""Of `write_events`, whose frames are so far apart that it lasts for more than 10 s."""
GAP, EMPTY, MOVING, HALF = 10, (14, 16), (4, 8), 20
"""Frames of `write_events`: the one after missing ones, the first and last ones without points, and
with motion, and the one from which on half of the zones are valid."""
GRIDS = {"small": (4, 4), "wide": (4, 8), "tall": (8, 4)}
"""{sensor of `write_grids`: its rows and columns}."""
OPTICAL = "camera_color_optical_frame"
ZONES = 64
"""Of a sensor, but for those of `write_grids`."""


def stamps_of_events() -> NDArray[np.int64]:
    """Stamps of `write_events` (FRAMES,), nanoseconds: two periods more pass before `GAP`."""
    k = np.arange(FRAMES)
    return np.round((k + 2 * (k >= GAP)) * PERIOD * 1e9).astype(np.int64)


def write_events(path: Path) -> Path:
    """A wall; a gap, empty frames, true motion, and fewer valid zones in the end."""
    file = ForeignFile()
    for k, stamp in enumerate(stamps_of_events().tolist()):
        millimetres = np.full((8, 8), 1000, "<u2")
        if EMPTY[0] <= k <= EMPTY[1]:
            millimetres[:] = 0
        if k >= HALF:
            millimetres[:4] = 0
        _add(file, "eye", stamp, millimetres)
        _place(file, "eye", stamp, 0.0)
        moves = MOVING[0] <= k <= MOVING[1]
        velocity = twist(stamp, "world", np.array([0.2 * moves, 0.0, 0.0]))
        file.add("/target/velocity", "geometry_msgs/msg/TwistStamped", velocity, stamp)
    return file.write(path)


def write_optical(path: Path) -> Path:
    """A wall before a camera that nothing places: the fixed frame is the camera's own."""
    file = ForeignFile()
    for stamp in range(0, 12 * 66_000_000, 66_000_000):
        _add(file, OPTICAL, stamp, np.full((8, 8), 1000, "<u2"))
    return file.write(path)


def distances(rows: int, columns: int) -> NDArray[np.uint16]:
    """Distances (rows, columns) in mm that the sensors of `write_grids` read, each its own."""
    row, column = np.mgrid[0:rows, 0:columns]
    return (600 + 200 * row + 25 * column).astype("<u2")


def write_grids(path: Path) -> Path:
    """Sensors of several grids, beside each other."""
    file = ForeignFile()
    for stamp in range(0, 12 * 66_000_000, 66_000_000):
        for place, (name, grid) in enumerate(GRIDS.items()):
            _add(file, name, stamp, distances(*grid))
            _place(file, name, stamp, 0.2 * place)
    return file.write(path)


def write_warned(path: Path) -> Path:
    """No truth, a sensor that nothing places, one placed too late, and a reading that is twice."""
    file = ForeignFile()
    for k in range(12):
        stamp, wall = k * 66_000_000, np.full((8, 8), 1000, "<u2")
        _add(file, "eye", stamp, wall)
        _add(file, "lost", stamp, wall)
        if k == 5:
            _add(file, "eye", stamp, wall)
        if k > 0:
            _place(file, "eye", stamp, 0.0)
    return file.write(path)


def _add(file: ForeignFile, name: str, stamp: int, millimetres: NDArray[np.uint16]) -> None:
    """A sensor's reading; zones are as large as those of a sensor with 8 x 8 of them."""
    rows, columns = millimetres.shape
    info = camera_info(stamp, name)
    k = list(info["k"])
    k[2], k[5] = (columns - 1) / 2, (rows - 1) / 2
    info |= {"height": rows, "width": columns, "k": k}
    depth = image(stamp, name, millimetres, "16UC1")
    file.add(f"/{name}/camera_info", "sensor_msgs/msg/CameraInfo", info, stamp)
    file.add(f"/{name}/image", "sensor_msgs/msg/Image", depth, stamp)


def _place(file: ForeignFile, name: str, stamp: int, x: float) -> None:
    placed = transforms(stamp, [("world", name, at(x=x, z=0.5))])
    file.add("/tf", "tf2_msgs/msg/TFMessage", placed, stamp)
