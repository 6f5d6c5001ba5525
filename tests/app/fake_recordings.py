"""A recording and a browser client that exist in memory alone."""

from pathlib import Path
from typing import Any

import numpy as np

from app.analysis.library import Entry, Opened
from recordings import Cloud, PairTruth, RecordedSensor
from robot_assets import Rig, Robot, SensorModel

PERIOD = 1 / 15
SPEED = np.array([0.0, 0.15, 0.0])
FRAMES = 40


def grid(centre, spacing=0.02, side=10) -> Any:
    steps = (np.arange(side) - (side - 1) / 2) * spacing
    x, z = np.meshgrid(steps, steps)
    return np.asarray(centre) + np.stack([x.ravel(), np.zeros(x.size), z.ravel()], axis=1)


class FakeRecording:
    """A patch moves along y at 0.15 m/s among four that rest; one sensor, or a rig on a robot."""

    def __init__(
        self,
        robot: Robot | None = None,
        rig: Rig | None = None,
        name: str = "fake",
        frames: int = FRAMES,
    ):
        self.robot, self._rig, self.name = robot, rig, name
        self.path = Path(f"/nowhere/{name}.mcap")
        self.stamps = 100 + PERIOD * np.arange(frames)
        self.provenance = None
        self.simulated = False
        self.truth_frame = None
        self.fixed_frame = robot.base if robot else "world"
        self.warnings = ()
        self.has_truth, self.duplicates = True, 0
        self.object_meshes: dict[str, Any] = {}
        self.unplaced = np.zeros(frames, dtype=bool)
        self.closed = False
        rays = (rig.model if rig else SensorModel(rows=20, columns=25)).directions
        sensors = [(s.name, s.ring) for s in rig.sensors] if rig else [("front", "")]
        self.sensors = tuple(
            RecordedSensor(n, ring, n, rays, lambda x: x, (0.02, 4.0)) for n, ring in sensors
        )
        self.static = np.vstack(
            [grid(c) for c in ([1, 1, 0.5], [-1, 1, 0.5], [1, -1, 0.5], [-1, -1, 0.5])]
        )
        self.moving = grid([0, 0.8, 0.7])

    def __len__(self):
        return len(self.stamps)

    def close(self):
        self.closed = True

    def cloud(self, k, max_range=4.0):
        points = np.vstack([self.static, self.moving + SPEED * PERIOD * k])
        rays = np.stack([sensor.directions for sensor in self.sensors])
        # Zone by zone, wherever the points are.
        sensor, zone = np.divmod(np.arange(len(points)), rays[0, ..., 0].size)
        ranges = np.full(rays.shape[:3], np.nan)
        ranges.reshape(-1)[: len(points)] = 1.0
        return Cloud(
            points=points,
            sensor=sensor,
            zone=zone,
            directions=rays / np.linalg.norm(rays, axis=-1, keepdims=True),
            ranges=ranges,
            T_fixed_sensor=self.T_fixed_sensor(k),
            stamp=float(self.stamps[k]),
        )

    def latest_messages(self, k):
        return np.full(len(self.sensors), self.stamps[k])

    def point_truth(self, k, max_range=4.0):
        return self.pair_truth(k, k).points

    def T_fixed_sensor(self, k):  # noqa: N802
        if self._rig:
            links = self.link_poses(k)
            return np.stack([links[s.link] @ s.T_link_sensor for s in self._rig.sensors])
        pose = np.eye(4)[None].copy()
        pose[0, 0, 3] = 0.01 * k
        return pose

    def object_poses(self, k):
        pose = np.eye(4)
        pose[:3, 3] = np.array([0, 0.8, 0.7]) + SPEED * PERIOD * k
        return dict.fromkeys(self.object_meshes, pose)

    def truth(self, k):
        return SPEED

    def pair_truth(self, source_k, target_k, max_range=4.0):
        size = len(self.static) + len(self.moving)
        points = np.zeros((size, 3))
        points[len(self.static) :] = SPEED
        return PairTruth(np.broadcast_to(SPEED, (size, 3)), points)

    def joint_positions(self, k):
        if not self.robot:
            return {}
        return dict.fromkeys(self.robot.joint_names[:7], 0.0) | {
            self.robot.joint_names[1]: -0.5 + 0.02 * k,
            self.robot.joint_names[3]: -1.8,
        }

    def link_poses(self, k):
        return self.robot.link_poses(self.joint_positions(k)) if self.robot else {}


def fake_recording(**arguments) -> Any:
    """A `FakeRecording` that passes for a `Recording`."""
    return FakeRecording(**arguments)


def fake_opened(recording: Any = None) -> Opened:
    recording = recording or fake_recording()
    entry = Entry(recording.name, recording.path)
    return Opened(entry, recording, (str(recording.path), 0, 0))
