"""Good recordings that mutants are made of."""

from functools import lru_cache
from itertools import islice
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np

from recordings import Provenance
from recordings.simulation import SCENARIOS
from recordings.writer import RecordingWriter
from tests.recordings.foreign import ForeignFile, at, image, joint_state, pose, transforms, twist
from tests.recordings.room import write_room
from tests.recordings.simulation.made import COARSE, ROBOT, frames
from tests.robot_assets.urdf import box_link, joint, urdf

_FRAMES = 4
ARM = urdf(
    box_link("base", (0.1, 0.1, 0.1)),
    box_link("hand", (0.1, 0.2, 0.1), (0, 0, 0.2)),
    joint(
        "joint1",
        "base",
        "hand",
        inside='<limit lower="-1" upper="1" effort="1" velocity="1"/><origin xyz="0 0 0.5"/>',
    ),
)
"""A robot of two boxes."""


@lru_cache(maxsize=1)
def seeds() -> dict[str, bytes]:
    """{name: content} of good recordings of a few frames: of our writer, and of others."""
    with TemporaryDirectory() as folder:
        paths = [_ours(Path(folder)), _room(Path(folder)), arm(Path(folder) / "arm.mcap")]
        return {path.stem: path.read_bytes() for path in paths}


def arm(path: Path, description: str = ARM) -> Path:
    """A sensor on a robot with a description, a moving object, and twist and pose as truth."""
    file = ForeignFile()
    file.add("/robot_description", "std_msgs/msg/String", {"data": description}, 0)
    for k in range(_FRAMES):
        stamp = 10**9 + k * 66_666_667
        ranges = np.full((8, 8), 1000 - 10 * k, "<u2")
        file.add("/eye/depth", "sensor_msgs/msg/Image", image(stamp, "eye", ranges, "16UC1"), stamp)
        tf = transforms(stamp, [("hand", "eye", at(z=0.1))])
        file.add("/tf", "tf2_msgs/msg/TFMessage", tf, stamp)
        state = joint_state(stamp, {"joint1": 0.1 * k})
        file.add("/joint_states", "sensor_msgs/msg/JointState", state, stamp)
        velocity = twist(stamp, "hand", np.array([0.0, 0.0, -0.15]))
        file.add("/target/velocity", "geometry_msgs/msg/TwistStamped", velocity, stamp)
        place = pose(stamp, "hand", at(z=1.6 - 0.01 * k))
        file.add("/target/pose", "geometry_msgs/msg/PoseStamped", place, stamp)
    return file.write(path)


def _ours(folder: Path) -> Path:
    path = folder / "ours.mcap"
    scenario = SCENARIOS["towards"]
    provenance = Provenance(True, scenario.name, 0.6, 1, 0, "none: no noise", "a test")
    with RecordingWriter(path, ROBOT, COARSE, provenance) as writer:
        for frame in islice(frames(scenario, rig=COARSE), _FRAMES):
            writer.write(frame)
    return path


def _room(folder: Path) -> Path:
    return write_room(folder / "room.mcap", frames=_FRAMES, tells_points=True).path
