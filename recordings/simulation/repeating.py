"""Long simulated recordings: one simulation, played to and fro."""

import heapq
import itertools
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from recordings.frame import Frame, PointTruth
from recordings.simulation.noise import NoiseModel
from recordings.simulation.scenario import Scenario
from recordings.simulation.scene import Scene
from recordings.simulation.simulate import FIRST_STAMP, provenance, scene_of, simulate
from recordings.stamped_message import StampedMessage
from recordings.writer import RecordingWriter
from robot_assets import Rig, Robot

_Messages = list[StampedMessage]
_SECOND = 10**9
_ROUNDING = 10  # nanoseconds


@dataclass(frozen=True)
class Repetition:
    """How long a simulation is played to and fro.

    Attributes:
        duration: seconds of the recording.
        pose_rate: joints and poses per second between the frames, 0 for those of the frames alone.
    """

    duration: float
    pose_rate: int = 0

    @property
    def text(self) -> str:
        """What is repeated, as the recording's metadata say it."""
        between = f", joints and poses at {self.pose_rate} Hz between" if self.pose_rate else ""
        return (
            f"the simulated frames{between}, to and fro for {self.duration:g} s; on the way back "
            f"with velocities reversed"
        )

    @property
    def flags(self) -> str:
        """As on the command line."""
        poses = f"--pose-rate {self.pose_rate} " if self.pose_rate else ""
        return f"--duration {self.duration:g} {poses}"


def write_repeated(
    path: Path,
    scenario: Scenario,
    repetition: Repetition,
    *,
    speed: float,
    trial: int,
    seed: int,
    noise: NoiseModel,
    imperfections: Sequence[str] = (),
    robot: Robot,
    rig: Rig,
) -> int:
    """Simulate once, write it to and fro into an MCAP file, and return the number of frames.

    Rays are cast for the first pass alone; the way back has the same readings in reverse, with all
    velocities reversed. Joints and poses between frames are those of the trajectories. Messages
    are serialised once and written with ever new stamps, so that an hour takes minutes.

    Args:
        path: of the file; an existing one is replaced.
        scenario: to play.
        repetition: how long, and how many poses.
        speed: m/s of the target, 0 where nothing moves.
        trial: number of the trial, from 1.
        seed: of the random numbers, 0 or more.
        noise: model of the errors of readings.
        imperfections: names of the enabled ones.
        robot: the Panda that carries the sensors.
        rig: its sensors.

    Raises:
        RecordingError: the file cannot be written.
        RigError: a sensor is on a link that the robot does not have.
    """
    what = {"speed": speed, "trial": trial, "seed": seed, "imperfections": imperfections}
    frames = list(
        simulate(
            scenario,
            speed=speed,
            trial=trial,
            seed=seed,
            noise=noise,
            imperfections=imperfections,
            robot=robot,
            rig=rig,
        )
    )
    scene = scene_of(scenario, robot=robot, **what)
    about = provenance(path, scenario, noise=noise, rig=rig, flags=repetition.flags, **what)
    about = replace(about, repeated=repetition.text)
    start, count = round(frames[0].stamp * _SECOND), 0
    with RecordingWriter(path, robot, rig, about, scene.meshes) as writer:
        cycle = _Cycle(frames, scene, writer, repetition.pose_rate)
        for offset, messages, is_frame in cycle.played():
            if offset + _ROUNDING >= repetition.duration * _SECOND:
                break
            writer.write_again(messages, start + offset)
            count += is_frame
    return count


class _Cycle:
    """One way forth and back, as messages that want their stamps.

    Args:
        frames: of the way forth.
        scene: that they show.
        writer: of the recording.
        pose_rate: joints and poses per second between the frames.
    """

    def __init__(
        self, frames: list[Frame], scene: Scene, writer: RecordingWriter, pose_rate: int
    ) -> None:
        begin = frames[0].stamp
        stamps = [round((frame.stamp - begin) * _SECOND) for frame in frames]
        self._seconds = 2.0 * (frames[-1].stamp - begin) or 1.0
        self._period = round(self._seconds * _SECOND)
        back = [_backwards(frame) for frame in frames[-2:0:-1]]
        times = [*stamps, *(self._period - stamp for stamp in stamps[-2:0:-1])]
        self._frames: list[tuple[int, _Messages, bool]] = [
            (time, writer.prepared(frame), True)
            for time, frame in zip(times, [*frames, *back], strict=True)
        ]
        self._poses: list[tuple[int, _Messages, bool]] = []
        taken = set(times)
        for time in range(0, self._period, _SECOND // pose_rate) if pose_rate else ():
            if time not in taken:
                ahead = min(time, self._period - time) / _SECOND
                frame = _posed(frames[0], scene, begin - FIRST_STAMP + ahead)
                self._poses.append((time, writer.prepared_poses(frame), False))

    def played(self) -> Iterator[tuple[int, _Messages, bool]]:
        """(nanoseconds from the start, messages, whether it is a frame), on and on."""
        for n in itertools.count():
            start = round(n * self._seconds * _SECOND)  # no error adds up
            for time, messages, is_frame in heapq.merge(
                self._frames, self._poses, key=lambda item: item[0]
            ):
                yield start + time, messages, is_frame


def _posed(frame: Frame, scene: Scene, time: float) -> Frame:
    """A frame with the joints and the poses of the scene at a time."""
    return replace(
        frame,
        joint_positions=scene.own.joint_positions(time),
        T_base_target=scene.target(time).T_fixed_body,
        object_poses=scene.object_poses(time),
    )


def _backwards(frame: Frame) -> Frame:
    """A frame as it is passed on the way back."""
    truth = frame.truth
    return replace(
        frame,
        target_velocity=-frame.target_velocity,
        target_turn_rate=-frame.target_turn_rate,
        truth=PointTruth(
            truth.points, np.negative(truth.velocity), truth.object, truth.sensor, truth.zone
        ),
    )
