"""Simulation of a scenario as the sensors of a rig see it."""

from collections.abc import Collection, Iterator, Sequence
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from recordings.frame import Frame, PointTruth, Provenance
from recordings.rig_record import RIG_ATTACHMENT
from recordings.simulation.body import SURROUNDINGS, Body
from recordings.simulation.imperfections import Streams, in_order
from recordings.simulation.noise import NoiseModel
from recordings.simulation.scenario import Scenario
from recordings.simulation.scene import Scene
from recordings.simulation.sensing import Sensing
from recordings.simulation.sensors import PieceCaster, ZoneRays
from recordings.writer import RecordingWriter
from robot_assets import Rig, Robot, load_rig, rig_text

RATE = 15.0
"""Frames per second (paper, section III-A)."""
FIRST_STAMP = 1.0
"""Seconds; a stamp of 0 means "unknown" to ROS."""
_OFFSET = 0.015  # metres, largest random offset of a trial's start along each axis
RAMP = 0.25
"""Seconds of acceleration and of deceleration where there are ramps."""
_LOST = 0.05  # share of the frames
_JITTER_SIGMA, _MAX_JITTER = 0.004, 0.015  # seconds


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
    frames, bit by bit; other values give different noise and a different start.

    Args:
        scenario: to play.
        speed: m/s of the target, 0 where nothing moves.
        trial: number of the trial, from 1.
        seed: of the random numbers, 0 or more.
        noise: model of the errors of readings.
        imperfections: names of the enabled ones.
        robot: the Panda that carries the sensors.
        rig: its sensors, on any of its links.

    Raises:
        ValueError: the speed is not above 0, nothing moves and it is not 0, or there is no such
            imperfection.
        RigError: a sensor is on a link that the robot does not have.
    """
    rig.check_links(robot.links, robot.name)
    if scenario.still and speed != 0.0:
        raise ValueError(f"In {scenario.name} nothing moves; its speed is 0, got {speed}.")
    key = _key(scenario, speed, trial, seed)
    rng, streams = np.random.default_rng(key), Streams(key)
    enabled = in_order(imperfections)
    scene = _scene(scenario, speed, robot, rng, enabled)
    sensing = Sensing(len(rig.sensors), rig.model, noise, enabled, rng, streams)
    rays = ZoneRays(rig)
    T_link_sensor = np.stack([sensor.T_link_sensor for sensor in rig.sensors])
    static = PieceCaster({index: piece.mesh for index, piece in enumerate(scene.static)})
    surfaces = {index: piece.surface for index, piece in enumerate(scene.static)}
    for time, stamp, lost in _times(scene.duration, enabled, streams):
        links = scene.own.link_poses(time)
        T_base_sensor = np.stack([links[s.link] for s in rig.sensors]) @ T_link_sensor
        bodies = dict(enumerate(scene.bodies(time), len(scene.static)))
        moving = PieceCaster({index: body.posed_mesh() for index, body in bodies.items()})
        bundle = rays.in_fixed(T_base_sensor)
        hits = moving.cast(*bundle).nearest(static.cast(*bundle))
        surfaces |= {index: body.surface for index, body in bodies.items()}
        edges = rays.edges(hits) if sensing.needs_edges else None
        report = sensing.report(rays.seen(hits), edges, surfaces)
        if lost:
            continue
        in_sensor = report.seen.distance[..., None] * rig.model.directions
        # The stamp is wrong for the readings only; joints and poses are those at the stamp.
        target = scene.target(stamp)
        yield Frame(
            stamp=FIRST_STAMP + stamp,
            ranges=report.ranges,
            status=report.status,
            joint_positions=scene.own.joint_positions(stamp),
            T_base_target=target.T_fixed_body,
            target_velocity=target.rate[:3, 3],
            target_turn_rate=target.turn_rate,
            object_poses=scene.object_poses(stamp),
            truth=_truth(report.valid, in_sensor, report.seen.piece, T_base_sensor, bodies),
        )


def _key(scenario: Scenario, speed: float, trial: int, seed: int) -> list[int]:
    """Seed of a recording's generators."""
    return [seed, trial, round(speed * 1e6), *scenario.name.encode()]


def _scene(
    scenario: Scenario,
    speed: float,
    robot: Robot,
    rng: np.random.Generator,
    imperfections: Collection[str],
) -> Scene:
    """The scene of a recording, whose start is the first that its generator is asked for."""
    offset = rng.uniform(-_OFFSET, _OFFSET, 3)
    return Scene(scenario, speed, robot, offset, RAMP if "ramps" in imperfections else 0.0)


def _times(
    duration: float, enabled: Collection[str], streams: Streams
) -> Iterator[tuple[float, float, bool]]:
    """(time, stamp, whether it is lost) of each frame, in seconds from the start."""
    jitter_rng, loss_rng = streams.of("stamp_jitter"), streams.of("dropped_frames")
    for k in range(int(duration * RATE) + 1):
        normal = _JITTER_SIGMA * jitter_rng.standard_normal()
        jitter = float(np.clip(normal, -_MAX_JITTER, _MAX_JITTER))
        lost = bool(loss_rng.random() < _LOST) and "dropped_frames" in enabled
        stamp = k / RATE + (jitter if "stamp_jitter" in enabled else 0.0)
        yield k / RATE, stamp, lost


def _truth(
    valid: NDArray[np.bool_],
    in_sensor: NDArray[np.float64],
    piece: NDArray[np.int64],
    T_base_sensor: NDArray[np.float64],
    bodies: dict[int, Body],
) -> PointTruth:
    """Position on the centre ray and velocity of the surface that each valid zone measured."""
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


def scene_of(
    scenario: Scenario,
    *,
    speed: float,
    trial: int,
    seed: int,
    imperfections: Sequence[str],
    robot: Robot,
) -> Scene:
    """The scene that `simulate` plays with the same arguments."""
    rng = np.random.default_rng(_key(scenario, speed, trial, seed))
    return _scene(scenario, speed, robot, rng, in_order(imperfections))


def provenance(
    path: Path,
    scenario: Scenario,
    *,
    speed: float,
    trial: int,
    seed: int,
    noise: NoiseModel,
    imperfections: Sequence[str],
    rig: Rig,
    flags: str = "",
) -> Provenance:
    """Provenance of a simulation in a file, with the command that makes it.

    Args:
        path: of the file.
        scenario: that is played.
        speed: m/s of the target.
        trial: number of the trial.
        seed: of the random numbers.
        noise: model of the errors of readings.
        imperfections: names of the enabled ones.
        rig: the sensors.
        flags: further ones of the command, each with a space after it.
    """
    imperfections = in_order(imperfections)
    with_rig = "" if rig_text(rig) == rig_text(load_rig()) else f"--rig {RIG_ATTACHMENT} "
    also = f"--imperfections {' '.join(imperfections)} " if imperfections else ""
    return Provenance(
        simulated=True,
        scenario=scenario.name,
        speed=speed,
        trial=trial,
        seed=seed,
        noise=f"{noise.name}: {noise.text}",
        command=(
            f"tofscope simulate {scenario.name} --speed {speed:g} --trial {trial} --seed {seed} "
            f"--noise {noise.name} {also}{with_rig}{flags}--out {path.name}"
        ),
        imperfections=imperfections,
        rig=rig.name,
    )


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
        RigError: a sensor is on a link that the robot does not have.
    """
    what = {"speed": speed, "trial": trial, "seed": seed, "imperfections": imperfections}
    about = provenance(path, scenario, noise=noise, rig=rig, **what)
    count = 0
    meshes = scene_of(scenario, robot=robot, **what).meshes
    with RecordingWriter(path, robot, rig, about, meshes) as writer:
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
