"""Rays, ranges and status that a cloud hands out, for grids of any size."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from recordings import open_recording
from robot_assets import SensorModel, load_rig, load_robot
from tests.recordings.foreign import ForeignFile, at, camera_info, image, joint_state, transforms
from tests.recordings.test_joints import ARM, STEP

WIDE = 4 / (2 * np.tan(np.pi / 6))
"""Focal length of 4 zones that see 60 degrees, in zones."""


def walls(
    grids: dict[str, tuple[int, int]],
    focals: dict[str, float] | None = None,
    status: dict[str, np.ndarray] | None = None,
) -> ForeignFile:
    """Sensors of some rows and columns that look at a wall 1.5 m away."""
    file = ForeignFile()
    for k in range(3):
        stamp = k * STEP
        for name, grid in grids.items():
            wall = image(stamp, name, np.full(grid, 1500, "<u2"), "16UC1")
            file.add(f"/{name}/image", "sensor_msgs/msg/Image", wall, stamp)
        for name, focal in (focals or {}).items():
            info = camera_info(stamp, name, grids[name][0], focal)
            file.add(f"/{name}/camera_info", "sensor_msgs/msg/CameraInfo", info, stamp)
        for name, codes in (status or {}).items():
            told = image(stamp, name, codes, "8UC1")
            file.add(f"/{name}/status", "sensor_msgs/msg/Image", told, stamp)
    fixed = transforms(0, [("world", name, at()) for name in grids])
    file.add("/tf_static", "tf2_msgs/msg/TFMessage", fixed, 0)
    return file


def test_directions_and_ranges_give_the_points(tmp_path: Path):
    path = walls({"eye": (8, 8)}).write(tmp_path / "x.mcap")
    with open_recording(path) as recording:
        cloud = recording.cloud(1)
        rays = cloud.directions[0]
        assert np.linalg.norm(rays, axis=-1) == pytest.approx(np.ones((8, 8)))
        along = cloud.ranges[0, ..., None] / rays[..., 2:]
        row, column = np.divmod(cloud.zone, 8)
        np.testing.assert_allclose((along * rays)[row, column], cloud.points, atol=1e-12)
        np.testing.assert_array_equal(cloud.ranges, 1.5)
        assert cloud.status is None


def test_a_zone_without_a_return_has_a_direction_and_no_range(tmp_path: Path):
    codes = np.full((8, 8), 5, np.uint8)
    codes[2, 3] = 4
    path = walls({"eye": (8, 8)}, status={"eye": codes}).write(tmp_path / "x.mcap")
    with open_recording(path) as recording:
        cloud = recording.cloud(1)
        assert cloud.status is not None
        np.testing.assert_array_equal(cloud.status[0], codes)
        assert np.isfinite(cloud.directions).all()
        assert np.argwhere(np.isnan(cloud.ranges)).tolist() == [[0, 2, 3]]
        assert 2 * 8 + 3 not in cloud.zone


def test_4_x_4_zones_of_60_degrees_by_their_intrinsics(tmp_path: Path):
    path = walls({"eye": (4, 4)}, {"eye": WIDE}).write(tmp_path / "x.mcap")
    with open_recording(path) as recording:
        cloud = recording.cloud(1)
        assert cloud.points.shape == (16, 3)
        assert cloud.zone.tolist() == list(range(16))
        # The centres of the outer zones lie at three quarters of the half width.
        edge = 1.5 * 0.75 * np.tan(np.pi / 6)
        assert cloud.points[0] == pytest.approx((-edge, -edge, 1.5))
        assert cloud.points[15] == pytest.approx((edge, edge, 1.5))
        assert recording.warnings == ()


@pytest.mark.parametrize("grid", [(2, 2), (3, 5), (64, 64), (6, 2)])
def test_without_intrinsics_any_grid_sees_a_square_of_45_degrees(
    tmp_path: Path, grid: tuple[int, int]
):
    path = walls({"eye": grid}).write(tmp_path / "x.mcap")
    with open_recording(path) as recording:
        points = recording.cloud(1).points
        assert len(points) == grid[0] * grid[1]
        half = np.array([1 - 1 / grid[1], 1 - 1 / grid[0]]) * np.tan(np.pi / 8)
        assert points[-1, :2] == pytest.approx(1.5 * half)


def test_grids_of_several_sizes_are_padded(tmp_path: Path):
    codes = np.full((4, 4), 9, np.uint8)
    grids = {"a": (4, 4), "b": (8, 8), "c": (2, 6)}
    path = walls(grids, {"a": WIDE}, {"a": codes}).write(tmp_path / "x.mcap")
    with open_recording(path) as recording:
        assert [sensor.grid for sensor in recording.sensors] == list(grids.values())
        cloud = recording.cloud(1)
        assert cloud.ranges.shape == (3, 8, 8)
        assert cloud.directions.shape == (3, 8, 8, 3)
        for s, (rows, columns) in enumerate(grids.values()):
            inside = np.zeros((8, 8), dtype=bool)
            inside[:rows, :columns] = True
            np.testing.assert_array_equal(np.isfinite(cloud.ranges[s]), inside)
            np.testing.assert_array_equal(np.isfinite(cloud.directions[s]).all(axis=-1), inside)
            row, column = np.divmod(cloud.zone[cloud.sensor == s], 8)
            assert inside[row, column].all()
            assert len(row) == rows * columns
        assert cloud.status is not None
        assert (cloud.status[0, :4, :4] == 9).all()
        assert (cloud.status[0, 4:] == 255).all()
        assert (cloud.status[1:] == 255).all()


def test_intrinsics_for_another_size_are_said_and_not_used(tmp_path: Path):
    file = walls({"eye": (4, 4)})
    file.add("/eye/camera_info", "sensor_msgs/msg/CameraInfo", camera_info(0, "eye", 8), 0)
    with open_recording(file.write(tmp_path / "x.mcap")) as recording:
        assert recording.warnings == (
            "/eye/camera_info is for images of 8 x 8 zones and those of /eye/image are 4 x 4; "
            "a field of view of 45 degrees is assumed.",
        )
        assert recording.cloud(1).points[15, 0] == pytest.approx(1.5 * 0.75 * np.tan(np.pi / 8))


def on_a_panda(path: Path, grid: tuple[int, int]) -> Path:
    file = ForeignFile()
    for k in range(3):
        wall = image(k * STEP, "base_0", np.full(grid, 1000, "<u2"), "16UC1")
        file.add("/base_0/image", "sensor_msgs/msg/Image", wall, k * STEP)
        state = joint_state(k * STEP, ARM)
        file.add("/joint_states", "sensor_msgs/msg/JointState", state, k * STEP)
    return file.write(path)


@pytest.mark.parametrize("distance", ["perpendicular", "radial"])
def test_a_rigs_model_tells_what_a_reading_is_and_ranges_are_along_the_axis(
    tmp_path: Path, distance: str
):
    path = on_a_panda(tmp_path / "x.mcap", (4, 4))
    rig = load_rig()
    model = SensorModel(rows=4, columns=4, field_of_view=np.pi / 3, distance=distance)  # type: ignore[arg-type]
    with open_recording(path, rig=replace(rig, model=model)) as recording:
        cloud = recording.cloud(1)
        sensor = rig.sensors[0]
        link = load_robot().link_poses(ARM)[sensor.link]
        origin = (link @ sensor.T_link_sensor)[:3, 3]
        away = np.linalg.norm(cloud.points - origin, axis=1)
        cosine = cloud.directions[0, ..., 2].ravel()[cloud.zone]
        expected = np.ones(16) if distance == "radial" else 1 / cosine
        assert away == pytest.approx(expected)
        depth = cloud.directions[0, ..., 2] if distance == "radial" else np.ones((4, 4))
        assert cloud.ranges[0] == pytest.approx(depth)


def test_a_driver_that_counts_down_the_columns_may_have_more_columns_than_rows(tmp_path: Path):
    rig = load_rig()
    model = SensorModel(rows=3, columns=4, reading_order="column_major")
    for images in [(3, 4), (4, 3)]:
        path = on_a_panda(tmp_path / f"{images[0]}.mcap", images)
        with open_recording(path, rig=replace(rig, model=model)) as recording:
            assert recording.cloud(1).ranges.shape == (1, 3, 4)
            assert len(recording.cloud(1).points) == 12


def test_nothing_that_a_recording_hands_out_can_be_written_to(tmp_path: Path):
    file = walls({"eye": (4, 4)}, status={"eye": np.full((4, 4), 5, np.uint8)})
    for k in range(3):
        moved = transforms(k * STEP, [("world", "board", at(z=2.0 - 0.1 * k))])
        file.add("/tf", "tf2_msgs/msg/TFMessage", moved, k * STEP)
    with open_recording(file.write(tmp_path / "x.mcap"), truth_frame="board") as recording:
        cloud = recording.cloud(1)
        truth = recording.pair_truth(0, 2)
        assert truth is not None
        assert cloud.status is not None
        assert truth.points is not None
        arrays = (
            *(cloud.points, cloud.sensor, cloud.zone, cloud.directions, cloud.ranges),
            *(cloud.T_fixed_sensor, cloud.status, truth.velocity, truth.points),
        )
        for values in arrays:
            with pytest.raises(ValueError, match="read-only"):
                values[0] = 0
