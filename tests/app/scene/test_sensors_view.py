import numpy as np
import pytest

from app.scene.palettes import PAPER, palette
from app.scene.scene_root import FIXED
from app.scene.sensors_view import FRUSTUMS, SensorsView, half_extents
from robot_assets import SensorModel, load_rig
from tests.app.fake_recordings import fake_recording


@pytest.mark.parametrize("distance", ["perpendicular", "radial"])
def test_the_frustum_has_the_sensors_field_of_view(distance):
    model = SensorModel(distance=distance)
    half = np.tan(np.radians(22.5))
    assert half_extents(model.directions) == pytest.approx((half, half))


def test_a_narrow_field_of_view_keeps_its_shape():
    directions = SensorModel().directions.copy()
    directions[..., 0] *= 2
    width, height = half_extents(directions)
    assert width == pytest.approx(2 * height)


def test_sensors_without_a_known_pose_are_hidden(client):
    recording = fake_recording()
    view = SensorsView(client.scene, recording.sensors)
    frustum = client.node(f"{FIXED}/frustums/0_front")
    assert not frustum.visible
    view.show(recording.cloud(3).T_fixed_sensor)
    assert frustum.visible
    np.testing.assert_allclose(frustum.position, [0.03, 0, 0])
    view.show(np.full((1, 4, 4), np.nan))
    assert not frustum.visible


def test_a_rig_has_a_frustum_per_sensor_and_a_band_per_ring(client):
    from robot_assets import load_robot

    recording = fake_recording(robot=load_robot(), rig=load_rig())
    view = SensorsView(client.scene, recording.sensors)
    view.show(recording.cloud(0).T_fixed_sensor)
    names = list(client.scene._handle_from_node_name)
    frustums = [n for n in names if n.startswith(f"{FIXED}/frustums/") and n.count("/") == 3]
    assert len(frustums) == 24
    assert len([n for n in names if n.endswith("/ring")]) == 3
    view.remove()
    left = [n for n in client.scene._handle_from_node_name if n.endswith(("/ring", "/body"))]
    assert left == []


def test_frustums_in_which_something_moves_have_faint_faces(client):
    view = SensorsView(client.scene, fake_recording().sensors)
    faces = client.node(f"{FRUSTUMS}/0_front/faces")
    assert not faces.visible
    view.highlight([0], palette(PAPER, dark=False))
    assert faces.visible
    assert faces.opacity < 0.2
    view.highlight([], palette(PAPER, dark=False))
    assert not faces.visible
