"""The simulator: a scenario of the paper as the sensors of a rig see it."""

from collections.abc import Iterator, Sequence
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from recordings.frame import Frame, PointTruth, Provenance
from recordings.simulation.imperfections import Bias, Streams, in_order
from recordings.simulation.noise import NoiseModel
from recordings.simulation.scenario import Scenario
from recordings.simulation.scene import SURROUNDINGS, Body, Scene
from recordings.simulation.sensors import PieceCaster, ZoneRays, sensed
from recordings.writer import RecordingWriter
from robot_assets import Rig, Robot

RATE = 15.0
"""Frames per second (paper, section III-A)."""
_FIRST_STAMP = 1.0  # seconds; a stamp of 0 means "unknown" to ROS
_OFFSET = 0.015  # metres, the most by which a trial starts elsewhere along each axis


def simulate(
    scenario: Scenario,
    *,
    speed: float,
    trial: int,
    seed: int,
    noise: NoiseModel,
    imperfections: Sequence[str] = (),
    robot: Robot,
    rig: Rig,
) -> Iterator[Frame]:
    """Simulate one recording, frame by frame.

    Scenario, speed, trial and seed together seed one generator: the same four give the same
    frames, bit by bit, and every other choice gives other noise and another start.

    Args:
        scenario: what moves.
        speed: m/s of the mannequin.
        trial: number of the trial, from 1.
        seed: of the random numbers, 0 or more.
        noise: how readings err.
        imperfections: names of what else is wrong.
        robot: a Panda that wears the sensors.
        rig: its sensors.

    Raises:
        ValueError: the speed is not above 0, or there is no such imperfection.
    """
    key = [seed, trial, round(speed * 1e6), *scenario.name.encode()]
    rng, streams = np.random.default_rng(key), Streams(key)
    on = in_order(imperfections)
    bias = Bias(len(rig.sensors), streams.of("bias")) if "bias" in on else None
    scene = Scene(scenario, speed, robot, rng.uniform(-_OFFSET, _OFFSET, 3))
    rays = ZoneRays(rig)
    static = PieceCaster(dict(enumerate(scene.static)))
    for k in range(int(scene.duration * RATE) + 1):
        time = k / RATE
        links = scene.own.link_poses(time)
        T_base_sensor = np.stack([links[s.link] @ s.T_link_sensor for s in rig.sensors])
        bodies = dict(enumerate(scene.bodies(time), len(scene.static)))
        moving = PieceCaster({index: body.placed() for index, body in bodies.items()})
        bundle = rays.in_fixed(T_base_sensor)
        readings, piece = rays.readings(moving.cast(*bundle).before(static.cast(*bundle)))
        error = bias.error(readings) if bias else 0.0
        ranges = sensed(readings, rig.model, noise, rng, error)
        in_sensor = readings[..., None] * rig.model.directions
        yield Frame(
            stamp=_FIRST_STAMP + time,
            ranges=ranges,
            joint_positions=scene.own.joint_positions(time),
            T_base_target=scene.T_base_target(time),
            target_velocity=scene.target_velocity(time),
            truth=_truth(np.isfinite(ranges), in_sensor, piece, T_base_sensor, bodies),
        )


def _truth(
    valid: NDArray[np.bool_],
    in_sensor: NDArray[np.float64],
    piece: NDArray[np.int64],
    T_base_sensor: NDArray[np.float64],
    bodies: dict[int, Body],
) -> PointTruth:
    """Where each valid zone's surface is along its centre ray, and how it moves."""
    sensor, row, column = np.nonzero(valid)
    T, seen = T_base_sensor[sensor], piece[valid]
    points = np.einsum("nij,nj->ni", T[:, :3, :3], in_sensor[valid]) + T[:, :3, 3]
    velocity = np.zeros_like(points)
    number = np.full(len(points), SURROUNDINGS)
    for index, body in bodies.items():
        mine = seen == index
        velocity[mine] = body.velocity(points[mine])
        number[mine] = body.number
    return PointTruth(points, velocity, number, sensor, row * valid.shape[2] + column)


def write_simulation(
    path: Path,
    scenario: Scenario,
    *,
    speed: float,
    trial: int,
    seed: int,
    noise: NoiseModel,
    imperfections: Sequence[str] = (),
    robot: Robot,
    rig: Rig,
) -> int:
    """Simulate one recording into an MCAP file, and return its number of frames.

    The arguments are those of `simulate`; a file that exists is replaced.

    Raises:
        RecordingError: the file cannot be written.
    """
    imperfections = in_order(imperfections)
    also = f"--imperfections {' '.join(imperfections)} " if imperfections else ""
    provenance = Provenance(
        simulated=True,
        scenario=scenario.name,
        speed=speed,
        trial=trial,
        seed=seed,
        noise=f"{noise.name}: {noise.text}",
        command=(
            f"tofscope simulate {scenario.name} --speed {speed:g} --trial {trial} --seed {seed} "
            f"--noise {noise.name} {also}--out {path.name}"
        ),
        imperfections=imperfections,
    )
    count = 0
    with RecordingWriter(path, robot, rig, provenance) as writer:
        for frame in simulate(
            scenario,
            speed=speed,
            trial=trial,
            seed=seed,
            noise=noise,
            imperfections=imperfections,
            robot=robot,
            rig=rig,
        ):
            writer.write(frame)
            count += 1
    return count
