from pathlib import Path

import numpy as np
import pytest
from mcap.reader import make_reader
from mcap_ros2.decoder import DecoderFactory

from recordings import Frame, PointTruth, Provenance, RecordingError, open_recording
from recordings import ros_messages as ros
from recordings.point_truth import truth_fields
from recordings.writer import RecordingWriter
from robot_assets import load_rig, load_robot
from tests.recordings.foreign import at

ROBOT, RIG = load_robot(), load_rig()
POSE = dict(zip(ROBOT.joint_names, [0.1, -0.7, 0.2, -2.3, 0.3, 1.6, 0.7, 0.02], strict=True))
PROVENANCE = Provenance(
    simulated=True,
    scenario="towards",
    speed=0.15,
    trial=2,
    seed=7,
    noise="none",
    command="tofscope simulate towards",
)


def frames(count: int = 12) -> list[Frame]:
    rng = np.random.default_rng(0)
    made: list[Frame] = []
    for k in range(count):
        ranges = rng.uniform(0.5, 3.0, (24, 8, 8))
        ranges[rng.uniform(size=ranges.shape) < 0.1] = np.nan
        sensor, zone = np.nonzero(np.isfinite(ranges.reshape(24, 64)))
        moving = sensor % 2 == 1
        positions = {joint: value + 0.01 * k for joint, value in POSE.items()}
        links = ROBOT.link_poses(positions)
        T = np.stack([links[s.link] @ s.T_link_sensor for s in RIG.sensors])
        seen = ranges[..., None] * RIG.model.directions
        places = np.einsum("sij,srcj->srci", T[:, :3, :3], seen) + T[:, None, None, :3, 3]
        truth = PointTruth(
            points=places.reshape(24, 64, 3)[sensor, zone],
            velocity=np.where(moving[:, None], [0.0, -0.15 * (1 + k), 0.0], 0.0),
            object=moving.astype(np.int64),
            sensor=sensor,
            zone=zone,
        )
        velocity = np.array([0.0, -0.15 * (1 + k), 0.0])
        made.append(Frame(50 + k / 15, ranges, positions, at(y=0.7 - 0.01 * k), velocity, truth))
    return made


@pytest.fixture(scope="module")
def written(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("written") / "towards.mcap"
    write_all(path)
    return path


def write_all(path: Path) -> None:
    with RecordingWriter(path, ROBOT, RIG, PROVENANCE) as writer:
        for frame in frames():
            writer.write(frame)


def test_what_is_written_is_read(written: Path):
    with open_recording(written) as recording:
        assert recording.simulated
        assert recording.provenance == PROVENANCE
        assert recording.warnings == ()
        assert recording.fixed_frame == "panda_link0"
        assert [sensor.name for sensor in recording.sensors] == [s.name for s in RIG.sensors]
        assert {sensor.ring for sensor in recording.sensors} == {"base", "elbow", "end_effector"}
        for k, frame in enumerate(frames()):
            cloud = recording.cloud(k)
            assert recording.stamps[k] == pytest.approx(frame.stamp, abs=1e-9)
            np.testing.assert_allclose(cloud.ranges, frame.ranges, atol=0.00051)
            links = ROBOT.link_poses(frame.joint_positions)
            expected = [links[s.link] @ s.T_link_sensor for s in RIG.sensors]
            np.testing.assert_allclose(cloud.T_fixed_sensor, expected, atol=1e-6)
            assert recording.joint_positions(k) == pytest.approx(frame.joint_positions)
            truth = recording.truth(k)
            assert truth is not None
            np.testing.assert_allclose(truth, frame.target_velocity)


def test_the_truth_of_points_is_that_of_their_zones(written: Path):
    with open_recording(written) as recording:
        cloud = recording.cloud(3)
        velocity = recording.point_truth(3)
        assert velocity is not None
        expected = np.where(cloud.sensor[:, None] % 2 == 1, [0.0, -0.6, 0.0], 0.0)
        np.testing.assert_allclose(velocity, expected, atol=1e-6)
        pair = recording.pair_truth(2, 6)
        assert pair is not None
        assert pair.points is not None
        moving = recording.cloud(2).sensor % 2 == 1
        np.testing.assert_allclose(pair.velocity[:, 1], -0.75, atol=1e-6)
        np.testing.assert_allclose(pair.points[moving, 1], -0.75, atol=1e-6)
        np.testing.assert_allclose(pair.points[~moving], 0.0)


def test_the_target_frame_moves_as_the_twist_says(written: Path):
    with open_recording(written, truth_frame="target") as recording:
        pair = recording.pair_truth(1, 9)
        assert pair is not None
        np.testing.assert_allclose(pair.velocity[:, 1], -0.15, atol=1e-6)


def test_another_reader_finds_standard_messages(written: Path):
    with written.open("rb") as stream:
        reader = make_reader(stream, decoder_factories=[DecoderFactory()])
        assert reader.get_header().profile == "ros2"
        counts: dict[str, int] = {}
        for schema, channel, _, message in reader.iter_decoded_messages():
            assert schema is not None
            assert schema.encoding == "ros2msg"
            assert "offered_qos_profiles" in channel.metadata
            counts[channel.topic] = counts.get(channel.topic, 0) + 1
            if channel.topic == "/tof/elbow/3/image":
                assert (message.height, message.width, message.encoding) == (8, 8, "16UC1")
                assert message.header.frame_id == "tof_elbow_3_optical_frame"
    assert counts["/tof/base/0/image"] == counts["/tf"] == counts["/joint_states"] == 12
    assert counts["/tf_static"] == counts["/robot_description"] == 1


@pytest.mark.parametrize("sensors", [24, 256, 257, 1000])
def test_the_truth_of_points_counts_as_many_sensors_as_there_are(sensors: int):
    last, zeros = np.array([0, sensors - 1]), np.zeros((2, 3))
    truth = PointTruth(zeros, zeros, np.array([3, 40]), last, np.array([0, 4095]))
    table = truth_fields(ros.points(0, "base", truth, sensors))
    assert table["sensor"].tolist() == [0, sensors - 1]
    assert table["zone"].tolist() == [0, 4095]
    assert table["object"].tolist() == [3, 40]


def test_nothing_is_left_of_a_recording_that_failed(tmp_path: Path):
    path = tmp_path / "failed.mcap"

    def fail() -> None:
        with RecordingWriter(path, ROBOT, RIG, PROVENANCE) as writer:
            writer.write(frames(1)[0])
            raise KeyError("anything")

    with pytest.raises(KeyError):
        fail()
    assert list(tmp_path.iterdir()) == []


def test_a_place_that_cannot_be_written_is_one_sentence(tmp_path: Path):
    with pytest.raises(RecordingError, match="cannot be written: No such file"):
        RecordingWriter(tmp_path / "nowhere" / "x.mcap", ROBOT, RIG, PROVENANCE)


@pytest.mark.parametrize("before", [None, b"what was there"])
def test_a_full_disk_is_one_sentence_and_leaves_what_was_there(
    before: bytes | None, tmp_path: Path, full_disk: None
):
    path = tmp_path / "x.mcap"
    if before is not None:
        path.write_bytes(before)
    with pytest.raises(RecordingError, match=r"x\.mcap cannot be written: File too large\."):
        write_all(path)
    assert [(p.name, p.read_bytes()) for p in tmp_path.iterdir()] == (
        [] if before is None else [("x.mcap", before)]
    )
