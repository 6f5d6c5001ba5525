from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest

from recordings import Recording, open_recording
from recordings.decoding import Decoder
from recordings.layouts import all_samples
from recordings.mcap_file import McapFile
from recordings.message_kinds import JOINTS
from recordings.simulation import NOISE_MODELS, SCENARIOS, Repetition, write_repeated
from recordings.simulation.simulate import RATE, scene_of
from robot_assets import load_rig, load_robot
from tests.robot_assets.coarse_rig import COARSE_RIG

SECONDS = 5.0


@pytest.fixture(scope="module")
def path(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("repeated")
    (folder / "rig.toml").write_text(COARSE_RIG)
    count = write_repeated(
        folder / "to_and_fro.mcap",
        SCENARIOS["robot_moving"],
        Repetition(SECONDS, 200),
        speed=0.5,
        trial=1,
        seed=0,
        noise=NOISE_MODELS["none"],
        robot=load_robot(),
        rig=load_rig(folder / "rig.toml"),
    )
    assert count == 15 * SECONDS
    return folder / "to_and_fro.mcap"


@pytest.fixture(scope="module")
def recording(path: Path) -> Recording:
    return open_recording(path)


def test_it_lasts_as_long_as_asked_at_fifteen_frames_a_second(recording: Recording):
    assert len(recording) == 75
    np.testing.assert_allclose(np.diff(recording.stamps), 1 / 15, atol=1e-6)
    assert recording.warnings == ()


def test_the_metadata_tell_what_is_repeated(recording: Recording):
    source = recording.provenance
    assert source is not None
    assert source.simulated
    assert "to and fro for 5 s" in source.repeated
    assert "200 Hz" in source.repeated
    assert "--duration 5 --pose-rate 200 " in source.command


def test_the_way_back_is_the_way_forth_with_velocities_reversed(recording: Recording):
    same = {"speed": 0.5, "trial": 1, "seed": 0, "imperfections": ()}
    scene = scene_of(SCENARIOS["robot_moving"], robot=load_robot(), **same)
    middle = int(scene.duration * RATE)
    for step in (3, 9, 15):
        before, after = recording.cloud(middle - step), recording.cloud(middle + step)
        np.testing.assert_allclose(before.points, after.points, atol=1e-6)
        forth, back = recording.truth(middle - step), recording.truth(middle + step)
        assert forth is not None
        assert back is not None
        np.testing.assert_allclose(forth, -back, atol=1e-9)
        points, returned = (recording.point_truth(middle + s) for s in (-step, step))
        assert points is not None
        assert returned is not None
        np.testing.assert_allclose(points, -returned, atol=1e-6)


def test_velocities_are_those_of_the_poses(recording: Recording):
    moving = 0
    for k, after in pairwise(range(len(recording))):
        start, end = recording.truth(k), recording.truth(after)
        assert start is not None
        assert end is not None
        if np.allclose(start, end) and np.linalg.norm(start) > 0:
            places = [recording.object_poses(n)["target"][:3, 3] for n in (k, after)]
            step = recording.stamps[after] - recording.stamps[k]
            np.testing.assert_allclose((places[1] - places[0]) / step, start, atol=1e-3)
            moving += 1
    assert moving > 10


def test_poses_between_the_frames_are_those_of_the_trajectory(path: Path, recording: Recording):
    file = McapFile(path)
    decoder = Decoder(file)
    channel = next(c for c in file.channels if c.topic == "/joint_states")
    joints: dict[object, int] = {}
    found = all_samples(decoder, channel, JOINTS, lambda name: joints.setdefault(name, len(joints)))
    file.close()
    elbow = found.of == joints["panda_joint4"]
    stamps, values = found.stamps[elbow], found.values[elbow, 0]
    assert len(stamps) == pytest.approx(SECONDS * 200 + 75, abs=30)
    assert (np.diff(stamps) > 0).all()
    assert np.abs(np.diff(values)).max() < 0.01
    for k in range(len(recording)):
        at = np.searchsorted(stamps, round(recording.stamps[k] * 1e9))
        assert recording.joint_positions(k)["panda_joint4"] == pytest.approx(values[at], abs=1e-4)
