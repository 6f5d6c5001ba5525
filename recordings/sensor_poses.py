"""Poses of the sensors at each frame."""

from collections.abc import Sequence
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from recordings.chained_poses import ChainedPoses
from recordings.cloud import read_only
from recordings.robot_poses import RobotPoses
from recordings.transforms import TransformTree
from robot_assets import Sensor


class SensorPoses:
    """Poses of the sensors of a recording in the fixed frame.

    A sensor's pose is that of its frame in /tf; without one it comes from the rig's extrinsics and
    the robot's link.

    Args:
        frames: optical frame of each sensor.
        tree: poses of /tf.
        fixed_frame: of the sensor poses.
        rig_sensors: the rig's sensor for each, None where none matches.
        robot: of the recording, None where there is none.
        count: number of frames of the recording.
    """

    def __init__(
        self,
        frames: Sequence[str],
        tree: TransformTree,
        fixed_frame: str,
        rig_sensors: Sequence[Sensor | None],
        robot: RobotPoses | None,
        count: int,
    ) -> None:
        self._frames = frames
        self._tree = tree
        self._fixed_frame = fixed_frame
        self._by_rig = [
            None if tree.connected(fixed_frame, frame) else sensor
            for frame, sensor in zip(frames, rig_sensors, strict=True)
        ]
        self._chained = ChainedPoses(tree, fixed_frame, frames)
        self._robot = robot
        self._count = count

    @cached_property
    def unplaced(self) -> NDArray[np.bool_]:
        """(K,) whether a frame lies outside the known poses of every sensor; read-only."""
        unplaced = np.ones(self._count, dtype=bool)
        for frame, sensor in zip(self._frames, self._by_rig, strict=True):
            if not unplaced.any():
                break
            if sensor is None:
                unplaced &= ~self._tree.known(self._fixed_frame, frame, self._count)
            elif self._robot:
                unplaced &= ~self._robot.known(sensor.link, self._count)
        return read_only(unplaced)

    def at(self, k: int) -> NDArray[np.float64]:
        """T_fixed_sensor (S, 4, 4) at frame `k`, NaN where unknown."""
        poses = self._chained.at(k)
        links = self._robot.link_poses(k) if self._robot and any(self._by_rig) else {}
        for s, sensor in enumerate(self._by_rig):
            if sensor and sensor.link in links:
                poses[s] = links[sensor.link] @ sensor.T_link_sensor
        return poses
