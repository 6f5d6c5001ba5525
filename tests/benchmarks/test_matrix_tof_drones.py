from pathlib import Path

import numpy as np
import pytest

from benchmarks.matrix_tof_drones import convert
from recordings import open_recording

VICON = "name,timeStamp,posx,posy,posz,qw,qx,qy,qz"


@pytest.fixture
def flight(tmp_path: Path) -> Path:
    """Three images; the drone flies 0.1 m along x every 100 ms, looking at a panel that stands."""
    lines = [VICON]
    for time in range(900, 1500, 100):
        lines.append(f"Drone,{time},{(time - 1000) / 1000},0,1,1,0,0,0")
        lines.append(f"Drone,{time},77,77,77,1,0,0,0")  # arrived under the same stamp
        lines.append(f"Surface,{time},2,0,1,1,0,0,0")
    (tmp_path / "state_Vicon.csv").write_text("\n".join(lines) + "\n")
    images = []
    for time in (1080, 1180, 1280):
        zones = [f"{2000 - (time - 1080)},1,5"] * 64
        zones[1], zones[2], zones[3] = "900,1,4", "900,0,255", "900,1,9"
        images += [f"{time},0,0", *zones]
    (tmp_path / "state_ToF.csv").write_text("\n".join(images) + "\n")
    return tmp_path


def test_a_flight_is_placed_in_the_world_at_the_time_it_was_seen(flight: Path):
    convert(flight, flight / "flight.mcap")
    with open_recording(flight / "flight.mcap", truth_frame="surface") as recording:
        assert recording.fixed_frame == "world"
        np.testing.assert_allclose(recording.stamps, [1.0, 1.1, 1.2])
        for k in range(3):
            cloud = recording.cloud(k)
            assert len(cloud.points) == 62  # statuses 4 and 255 are left out
            assert sorted(set(range(64)) - set(cloud.zone.tolist())) == [1, 2]
            far = cloud.zone > 3
            np.testing.assert_allclose(cloud.points[far, 0], 2.0, atol=1e-9)
        first = recording.cloud(0)
        top_left = first.points[first.zone == 0][0]
        assert top_left[1] > 0.5  # the drone's left
        assert top_left[2] > 1.5  # up
        assert first.ranges[0, 0, 3] == 0.9
        assert np.abs(recording.truth(1)).max() < 1e-12  # type: ignore[arg-type]


def test_in_the_sensors_frame_everything_comes_nearer(flight: Path):
    convert(flight, flight / "flight.mcap")
    frames = ("tof_front_optical_frame", "surface")
    with open_recording(flight / "flight.mcap", *frames) as recording:
        assert recording.truth(1) == pytest.approx([0, 0, -1], abs=1e-9)
        truth = recording.pair_truth(0, 2)
        assert truth is not None
        assert truth.points is not None
        np.testing.assert_allclose(truth.points, np.tile([0, 0, -1.0], (62, 1)), atol=1e-9)
