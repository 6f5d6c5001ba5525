from dataclasses import replace

import numpy as np
import pytest

from app.analysis.estimates import Estimates
from app.scene.arrows import linear
from app.scene.camera import Camera
from app.scene.clouds_view import (
    FLOW_NODE,
    SOURCE_NODE,
    STATIC_SOURCE_NODE,
    STATIC_TARGET_NODE,
    TARGET_NODE,
)
from app.scene.floor import GRID
from app.scene.flow_colours import faded
from app.scene.palettes import COLOUR_BLIND, PAPER, palette
from app.scene.scene import Scene
from app.scene.scene_root import FIXED
from app.scene.settings import (
    BY_CLUSTER,
    BY_DIRECTION,
    BY_SPEED,
    DIMMED,
    HIDDEN,
    SHOWN,
    ViewSettings,
)
from app.scene.theme import background
from app.scene.true_object import TRUE_OBJECT
from estimator import Label, Parameters
from recordings import ObjectMesh
from tests.app.fake_recordings import PERIOD, SPEED, fake_opened, fake_recording

COLOURS = palette(PAPER, dark=False)


@pytest.fixture(scope="module")
def pair():
    return Estimates().estimated(fake_opened(), 20, Parameters())


@pytest.fixture
def scene(client, pair):
    scene = Scene(client, ViewSettings())
    scene.open(fake_recording())
    scene.show(pair)
    scene.place_camera(pair)
    return scene


def colours(client, node):
    return np.unique(client.node(node).colors.reshape(-1, 3), axis=0).tolist()


def faint(*wanted):
    return sorted(faded(np.array(wanted), background(dark=False)).tolist())


def test_what_moves_stands_out_from_a_dimmed_scene(scene, client, pair):
    moving = pair.flow.moving
    np.testing.assert_allclose(client.node(SOURCE_NODE).points, pair.source.points[moving])
    assert len(client.node(STATIC_SOURCE_NODE).points) == (~moving).sum()
    assert colours(client, SOURCE_NODE) == [list(COLOURS.source)]
    assert colours(client, TARGET_NODE) == [list(COLOURS.target)]
    assert colours(client, STATIC_SOURCE_NODE) == faint(COLOURS.stationary)
    assert colours(client, STATIC_TARGET_NODE) == faint(COLOURS.target)
    sizes = [client.node(node).point_size for node in (STATIC_SOURCE_NODE, SOURCE_NODE)]
    assert sizes[0] < 0.6 * sizes[1]
    (cluster,) = [c for c in pair.flow.clusters if c.label == Label.MOVING]
    assert len(client.node(TARGET_NODE).points) == len(cluster.target)


def test_without_an_estimate_nothing_stands_back(scene, client, pair):
    scene.show(replace(pair, flow=None))
    assert len(client.node(STATIC_SOURCE_NODE).points) == 0
    assert len(client.node(TARGET_NODE).points) == len(pair.target.points)
    assert colours(client, SOURCE_NODE) == [list(COLOURS.source)]


def test_where_nothing_moves_all_is_static(scene, client):
    scene.show(Estimates().estimated(fake_opened(), 20, Parameters(n_min=200)))
    assert len(client.node(SOURCE_NODE).points) == len(client.node(TARGET_NODE).points) == 0
    assert colours(client, STATIC_SOURCE_NODE) == faint(COLOURS.unassigned)


def test_the_static_scene_can_be_shown_or_hidden(scene, client, pair):
    scene.change(ViewSettings(static_scene=HIDDEN))
    for node in (STATIC_SOURCE_NODE, STATIC_TARGET_NODE):
        assert len(client.node(node).points) == 0
    assert len(client.node(SOURCE_NODE).points) == pair.flow.moving.sum()
    scene.change(ViewSettings(static_scene=SHOWN))
    assert colours(client, STATIC_SOURCE_NODE) == [list(COLOURS.stationary)]
    dimmed = client.node(STATIC_SOURCE_NODE).point_size
    scene.change(ViewSettings(static_scene=DIMMED))
    assert client.node(STATIC_SOURCE_NODE).point_size < dimmed


def test_a_picked_cluster_dims_all_others(scene, client, pair):
    still = next(c for c in pair.flow.clusters if c.label != Label.MOVING)
    scene.change(ViewSettings(static_scene=SHOWN))
    scene.mark(pair, still)
    assert len(client.node(TARGET_NODE).points) == len(still.target)
    assert len(client.node(SOURCE_NODE).points) == 0  # the picked ones are drawn as such
    assert faint(COLOURS.source)[0] in colours(client, STATIC_SOURCE_NODE)
    assert colours(client, FLOW_NODE) == linear(np.array(faint(COLOURS.flow))).tolist()
    scene.mark(pair, None)
    assert colours(client, FLOW_NODE) == [linear(np.array(COLOURS.flow)).tolist()]


def test_sensors_that_see_something_moving_are_highlighted(scene, client, pair):
    frustum = client.node(f"{FIXED}/frustums/0_front")
    assert frustum.color == COLOURS.flow
    thick = frustum.thickness
    scene.show(Estimates().estimated(fake_opened(), 20, Parameters(delta=0.5)))
    assert frustum.color == COLOURS.frustum
    assert frustum.thickness < thick


def test_points_stand_for_the_true_object_where_its_surface_is_not_known(scene, client, pair):
    moving = pair.source.points[pair.truly_moving]
    expected = moving + SPEED * PERIOD * 8
    node = f"{TRUE_OBJECT}/points"
    np.testing.assert_allclose(client.node(node).points, expected, atol=1e-5)
    scene.show(replace(pair, truth=None))
    assert len(client.node(node).points) == 0


def test_the_true_object_is_drawn_where_it_is(client):
    recording = fake_recording()
    corners = np.eye(3, dtype=np.float32)
    recording.object_meshes = {"target": ObjectMesh(corners, np.array([[0, 1, 2]], np.uint32))}
    scene, surface = Scene(client, ViewSettings()), f"{TRUE_OBJECT}/0_target"
    scene.open(recording)
    for frame in (20, 25):
        pair = Estimates().estimated(fake_opened(recording), frame, Parameters())
        scene.show(pair)
        assert client.node(surface).visible
        here = np.array([0.0, 0.8, 0.7]) + SPEED * PERIOD * frame
        np.testing.assert_allclose(client.node(surface).position, here)
        assert len(client.node(f"{TRUE_OBJECT}/points").points) == 0
    assert "True object" in [entry.text for entry in scene.legend.entries]
    scene.show(replace(pair, object_poses={"target": np.full((4, 4), np.nan)}))
    assert not client.node(surface).visible
    assert len(client.node(f"{TRUE_OBJECT}/points").points) > 0
    scene.open(fake_recording())
    assert client.scene.get_handle_by_name(surface) is None


@pytest.mark.parametrize("shown", [BY_SPEED, BY_DIRECTION, BY_CLUSTER])
def test_arrows_tell_what_they_are_asked_for(scene, client, pair, shown):
    velocity = pair.flow.velocity.copy()
    moving = np.flatnonzero(pair.flow.label == Label.MOVING)
    velocity[moving[:50]] *= -0.2
    cluster = pair.flow.cluster.copy()
    cluster[moving[:50]] += 1
    flow = replace(pair.flow, velocity=velocity, cluster=cluster)
    scene.show(replace(pair, flow=flow))
    assert colours(client, FLOW_NODE) == [linear(np.array(COLOURS.flow)).tolist()]
    scene.change(ViewSettings(arrow_colours=shown))
    drawn = client.node(FLOW_NODE).colors[:, 0]
    assert len(np.unique(drawn[:50], axis=0)) == len(np.unique(drawn[50:], axis=0)) == 1
    assert (drawn[0] != drawn[50]).any()


def test_lamps_are_dimmer_in_the_dark(scene, client):
    full = client.node("/lights/key").intensity
    scene.change(ViewSettings(dark=True))
    assert 0 < client.node("/lights/key").intensity < full
    scene.change(ViewSettings())
    assert client.node("/lights/key").intensity == full


def test_another_palette_paints_everything(scene, client):
    scene.change(ViewSettings(colours=COLOUR_BLIND, dark=True))
    other = palette(COLOUR_BLIND, dark=True)
    assert colours(client, TARGET_NODE) == [list(other.target)]
    assert colours(client, FLOW_NODE) == [linear(np.array(other.flow)).tolist()]
    assert colours(client, SOURCE_NODE) == [list(other.source)]
    assert client.node(GRID).cell_color == other.grid[0]


def test_points_keep_their_size_in_the_picture_however_far_the_camera_is(scene, client):
    sizes, client.camera.look_at = [], np.zeros(3)
    for distance in (0.3, 4.0):
        client.camera.position = np.array([0.0, -distance, 0.0])
        scene.adapt_sizes()
        sizes.append(client.node(SOURCE_NODE).point_size / distance)
    assert sizes[0] == pytest.approx(sizes[1])
    # 7 of 720 pixels are a diameter of this part of the picture's height.
    assert sizes[0] == pytest.approx(7 / 720 * np.tan(client.camera.fov / 2))


def test_turning_the_camera_sends_nothing(scene, client):
    client.camera.look_at, client.camera.position = np.zeros(3), np.array([2.0, 0.0, 0.0])
    scene.adapt_sizes()
    client.take_sent()
    client.camera.position = np.array([0.0, 2.0, 0.0])
    scene.adapt_sizes()
    assert client.take_sent() == []


def test_a_restored_camera_has_its_sizes_at_once(client, pair):
    scene = Scene(client, ViewSettings())
    scene.open(fake_recording())
    scene.show(pair)
    scene.set_camera(Camera((0.0, 2.0, 0.0), (0.0, 0.0, 0.0), 0.5))
    assert client.node(SOURCE_NODE).point_size == pytest.approx(7 / 720 * 2 * np.tan(0.25))


def test_a_frame_with_a_picked_cluster_sends_the_source_once(scene, client, pair, monkeypatch):
    drawn, source = [], scene._clouds.source
    real = source.show
    monkeypatch.setattr(source, "show", lambda *a: drawn.append(len(a[0])) or real(*a))
    (moving,) = [c for c in pair.flow.clusters if c.label == Label.MOVING]
    scene.show(pair, picked=moving)
    assert drawn == [len(pair.source.points) - len(moving.source)]


def test_the_label_of_a_picked_cluster_stays_in_view(scene, client, pair):
    wall = next(c for c in pair.flow.clusters if c.label != Label.MOVING)
    points = pair.source.points[wall.source]
    seen = points[0]
    eye = seen + np.array([0.0, -0.3, 0.0])
    scene.set_camera(Camera(tuple(eye.tolist()), tuple(seen.tolist()), 0.3))
    scene.mark(pair, wall)
    label = client.node(f"{FIXED}/picked/label")
    assert np.linalg.norm(label.position - seen) < 0.1
    far = Camera((0.0, -9.0, 0.0), tuple(points.mean(axis=0).tolist()), 0.7)
    scene.set_camera(far)
    assert np.linalg.norm(label.position - seen) > 0.1


def test_a_huge_box_and_a_label_above_the_picture_do_not_stay_there(scene, client, pair):
    wall = next(c for c in pair.flow.clusters if c.label != Label.MOVING)
    points = pair.source.points[wall.source]
    middle, near = points.mean(axis=0), np.array([0.0, -0.08, 0.0])
    scene.mark(pair, wall)
    scene.set_camera(Camera.of(middle + 40 * near, middle, 0.7))
    box, label = (client.node(f"{FIXED}/picked/{name}") for name in ("box", "label"))
    assert box.visible
    scene.set_camera(Camera.of(middle + near, middle, 0.7))
    assert not box.visible
    up = np.array([0.0, 0.0, 1.0])
    assert scene.camera().sees(np.array([label.position]), up, 1.0).all()


def test_nothing_is_dimmed_until_something_moves(client, pair):
    scene = Scene(client, ViewSettings())
    scene.open(fake_recording())
    still = replace(pair, flow=replace(pair.flow, label=np.full(len(pair.flow.label), 1)))
    scene.show(still)
    assert colours(client, STATIC_TARGET_NODE) == [list(COLOURS.target)]
    assert "Target" in [entry.text for entry in scene.legend.entries]
    scene.show(pair)
    assert colours(client, STATIC_TARGET_NODE) == faint(COLOURS.target)
    scene.show(still)  # played on, it must not flash up
    assert colours(client, STATIC_TARGET_NODE) == faint(COLOURS.target)


def test_an_empty_cloud_sends_no_empty_list_of_colours(client, pair):
    scene = Scene(client, ViewSettings())
    scene.open(fake_recording())
    scene.show(replace(pair, source=None, flow=None))
    assert client.node(SOURCE_NODE).colors.size == 3
    assert len(client.node(SOURCE_NODE).points) == 0
