from dataclasses import replace
from itertools import islice
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.spatial import KDTree

from estimator import Parameters, PooledErrors, estimate_scene_flow
from recordings import Frame, open_recording, sample_paths
from recordings.simulation import (
    NOISE_MODELS,
    PAPER_SCENARIOS,
    SCENARIOS,
    write_simulation,
)
from recordings.simulation.body import OWN_ROBOT, SECOND_ROBOT, SURROUNDINGS, TARGET
from tests.recordings.simulation.made import COARSE, RIG, ROBOT, frames, written

# In this posture the robot sees itself, as it does not when it stands upright.
BENT = replace(
    SCENARIOS["robot_moving"], posture=(np.pi / 2, -0.785, 0.0, -2.356, 0.0, 1.571, 0.785)
)


@pytest.fixture(scope="module")
def exact() -> list[Frame]:
    return list(frames(BENT))


def test_there_are_fifteen_frames_a_second_from_rest_to_rest(exact: list[Frame]):
    stamps = np.array([frame.stamp for frame in exact])
    assert np.diff(stamps) == pytest.approx(np.full(len(exact) - 1, 1 / 15))
    speeds = [float(np.linalg.norm(frame.target_velocity)) for frame in exact]
    assert speeds[0] == speeds[-1] == 0.0
    moving = np.flatnonzero(speeds)
    assert 0.30 / 0.6 * 15 - 1 <= len(moving) <= 0.30 / 0.6 * 15 + 1
    assert np.ptp(moving) == len(moving) - 1
    assert {round(speeds[k], 9) for k in moving} == {0.6}


def test_truth_is_where_exact_readings_are(exact: list[Frame]):
    for frame in exact[::5]:
        links = ROBOT.link_poses(frame.joint_positions)
        T = np.stack([links[s.link] @ s.T_link_sensor for s in RIG.sensors])
        in_sensor = frame.ranges[..., None] * RIG.model.directions
        points = np.einsum("sij,srcj->srci", T[:, :3, :3], in_sensor) + T[:, None, None, :3, 3]
        truth = frame.truth
        assert len(truth.points) == np.isfinite(frame.ranges).sum()
        assert truth.points == pytest.approx(
            points.reshape(24, 64, 3)[truth.sensor, truth.zone], abs=1e-9
        )


def test_truth_tells_what_moves_how(exact: list[Frame]):
    for frame in exact:
        truth = frame.truth
        assert set(np.unique(truth.object)) >= {SURROUNDINGS, TARGET, OWN_ROBOT}
        assert not truth.velocity[truth.object == SURROUNDINGS].any()
        mannequin = truth.velocity[truth.object == TARGET]
        assert mannequin == pytest.approx(np.tile(frame.target_velocity, (len(mannequin), 1)))
        assert (truth.object < SECOND_ROBOT + len(ROBOT.collision_meshes)).all()
    own = [f.truth.velocity[f.truth.object == OWN_ROBOT] for f in exact]
    assert not own[0].any()
    assert max(np.linalg.norm(v, axis=1).max(initial=0.0) for v in own) > 0.1


def test_the_sensors_see_enough_of_the_mannequin(exact: list[Frame]):
    seen = [int((frame.truth.object == TARGET).sum()) for frame in exact]
    assert min(seen) > 60
    assert max(seen) < 250


def test_the_same_seed_gives_the_same_frames_and_another_gives_others():
    towards = SCENARIOS["towards"]
    first, again = (list(islice(frames(towards, noise="paper"), 8)) for _ in range(2))
    for a, b in zip(first, again, strict=True):
        assert np.array_equal(a.ranges, b.ranges, equal_nan=True)
        assert np.array_equal(a.truth.points, b.truth.points)
        assert np.array_equal(a.T_base_target, b.T_base_target)
    others = [frames(towards, noise="paper", seed=1), frames(towards, noise="paper", trial=2)]
    for other in map(next, others):
        assert not np.array_equal(first[0].ranges, other.ranges, equal_nan=True)
        shift = np.abs(other.T_base_target - first[0].T_base_target).max()
        assert 0.0 < shift <= 0.03


def test_a_written_recording_says_what_it_is_and_is_the_same_again(tmp_path: Path):
    paths = [tmp_path / "a" / "x.mcap", tmp_path / "b" / "x.mcap"]
    counts: list[int] = []
    for path in paths:
        path.parent.mkdir()
        written = write_simulation(
            path,
            SCENARIOS["sideways"],
            speed=0.9,
            trial=3,
            seed=5,
            noise=NOISE_MODELS["paper"],
            imperfections=("bias",),
            robot=ROBOT,
            rig=COARSE,
        )
        counts.append(written)
    assert paths[0].read_bytes() == paths[1].read_bytes()
    with open_recording(paths[0]) as recording:
        assert [len(recording)] * 2 == counts
        assert recording.warnings == ()
        source = recording.provenance
        assert source is not None
        assert source.simulated
        assert (source.scenario, source.speed, source.trial, source.seed) == ("sideways", 0.9, 3, 5)
        assert source.noise.startswith("paper: Gaussian")
        assert source.command == (
            "tofscope simulate sideways --speed 0.9 --trial 3 --seed 5 --noise paper "
            "--imperfections bias --rig rig.toml --out x.mcap"
        )
        assert source.imperfections == ("bias",)


def test_the_reader_removes_the_robots_own_body(exact: list[Frame], tmp_path: Path):
    path = tmp_path / "x.mcap"
    write_simulation(
        path,
        BENT,
        speed=0.6,
        trial=1,
        seed=0,
        noise=NOISE_MODELS["none"],
        robot=ROBOT,
        rig=RIG,
    )
    with open_recording(path) as recording:
        assert {s.name for s in recording.sensors} == {s.name for s in RIG.sensors}
        where = [[s.name for s in recording.sensors].index(s.name) for s in RIG.sensors]
        for k in range(0, len(recording), 6):
            cloud, truth = recording.cloud(k), exact[k].truth
            numbers = np.full(24 * 64, -1)
            numbers[np.array(where)[truth.sensor] * 64 + truth.zone] = truth.object
            seen = numbers[cloud.sensor * 64 + cloud.zone]
            assert (numbers == OWN_ROBOT).sum() > 30
            assert OWN_ROBOT not in seen
            assert (seen == TARGET).sum() > 60


def test_samples_are_one_of_each_scenario_and_small():
    paths = sample_paths()
    assert sum(path.stat().st_size for path in paths) < 3e6
    scenarios: list[str] = []
    for path in paths:
        with open_recording(path) as recording:
            assert recording.simulated
            assert recording.provenance is not None
            scenarios.append(recording.provenance.scenario)
    assert sorted(scenarios) == sorted(PAPER_SCENARIOS)


@pytest.mark.parametrize(("scenario", "coverage"), [("towards", 0.9), ("sideways", 0.8)])
def test_algorithm_1_finds_the_motion_in_the_samples(scenario: str, coverage: float):
    path = next(p for p in sample_paths() if p.stem.startswith(scenario))
    errors = PooledErrors()
    with open_recording(path) as recording:
        for k in range(8, len(recording)):
            truth = recording.pair_truth(k - 8, k)
            ends = [recording.truth(k - 8), recording.truth(k)]
            if truth is None or any(v is None or not v.any() for v in ends):
                continue
            interval = float(recording.stamps[k] - recording.stamps[k - 8])
            source, target = recording.cloud(k - 8), recording.cloud(k)
            flow = estimate_scene_flow(source, target, interval, Parameters())
            errors.add(flow, interval, truth.velocity, truth.points)
    metrics = errors.metrics()
    assert metrics.pairs >= 6
    assert metrics.angle_deg < 18
    assert metrics.velocity_error < 0.09
    assert metrics.coverage > coverage


@pytest.mark.parametrize("scenario", PAPER_SCENARIOS)
def test_samples_are_the_files_that_the_simulator_writes(scenario: str, tmp_path: Path):
    """Bit for bit: nothing that can be switched on changes what is made without it."""
    path = next(p for p in sample_paths() if p.stem.startswith(scenario + "_0"))
    again = tmp_path / path.name
    with open_recording(path) as shipped:
        source = shipped.provenance
        assert source is not None
        written(again, scenario, speed=source.speed, noise="paper")
        with open_recording(again) as made:
            assert made.provenance == source
            assert len(made) == len(shipped)
            pairs = [(shipped.cloud(k).ranges, made.cloud(k).ranges) for k in range(len(shipped))]
    # On another processor a ray that grazes an edge may fall to its other side.
    assert np.mean([np.array_equal(a, b, equal_nan=True) for a, b in pairs]) > 0.5
    differences = np.abs([a - b for a, b in pairs])
    assert np.nanmedian(differences) < 6e-4
    assert np.nanmean(differences < 6e-4) > 0.99


@pytest.mark.parametrize("scenario", ["walking", "turning"])
def test_the_points_of_a_moving_object_lie_on_its_mesh(scenario: str, tmp_path: Path):
    path = written(tmp_path / "x.mcap", scenario, rig=COARSE)
    distances: list[NDArray[np.float64]] = []
    with open_recording(path) as recording:
        exact = frames(SCENARIOS[scenario], SCENARIOS[scenario].speeds[-1], rig=COARSE)
        for k, frame in enumerate(exact):
            poses, truth = recording.object_poses(k), frame.truth
            for name, mesh in recording.object_meshes.items():
                number = TARGET if name == "target" else int(name.removeprefix("object_"))
                points = truth.points[truth.object == number]
                surface = mesh.vertices @ poses[name][:3, :3].T + poses[name][:3, 3]
                away, _ = KDTree(surface).query(points)
                distances.append(away)
    # A zone measures the mean of what it sees, on its centre ray.
    away = np.concatenate(distances)
    assert len(away) > 50
    assert np.median(away) < 0.02
    assert (away < 0.1).mean() > 0.95
