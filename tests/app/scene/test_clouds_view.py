import numpy as np

from app.scene.clouds_view import CloudsView, arrows
from app.scene.palettes import PAPER, palette
from app.scene.scene_root import FIXED

PALETTE = palette(PAPER, dark=False)
GREEN = np.array([[0, 130, 45], [0, 131, 46]], dtype=np.uint8)


def test_arrows_leave_out_what_cannot_be_drawn():
    points = np.array([[0, 0, 0], [1, 0, 0], [2, 0, 0], [np.nan, 0, 0]], dtype=float)
    velocity = np.array([[0, 0.2, 0], [np.nan] * 3, [0, 0, 0], [0, 1, 0]])
    np.testing.assert_allclose(arrows(points, velocity, 0.5), [[[0, 0, 0], [0, 0.1, 0]]])


def test_heads_are_shorter_than_the_shortest_arrow(client):
    view = CloudsView(client.scene, PALETTE)
    view.show_flow(np.zeros((2, 3)), np.array([[0.01, 0, 0], [1, 0, 0]]), 1.0, GREEN)
    node = client.node(f"{FIXED}/flow")
    assert node.points.shape == (2, 2, 3)
    assert 0 < node.head_length < 0.01
    view.show_flow(np.zeros((1, 3)), np.array([[1.0, 0, 0]]), 1.0, GREEN[:1])
    assert 0.01 < node.head_length <= 0.03


def test_no_flow_draws_no_arrow(client):
    view = CloudsView(client.scene, PALETTE)
    view.show_flow(np.zeros((1, 3)), np.ones((1, 3)), 1.0, GREEN[:1])
    view.show_flow(np.zeros((1, 3)), np.full((1, 3), np.nan), 1.0, GREEN[:1])
    assert client.node(f"{FIXED}/flow").points.shape == (0, 2, 3)


def test_truth_is_one_arrow_or_none(client):
    view = CloudsView(client.scene, PALETTE)
    node = client.node(f"{FIXED}/truth")
    view.show_truth(np.array([1.0, 2, 3]), np.array([0, 0, 0.2]), 0.5)
    np.testing.assert_allclose(node.points, [[[1, 2, 3], [1, 2, 3.1]]], atol=1e-6)
    view.show_truth(np.zeros(3), None, 0.5)
    assert node.points.shape == (0, 2, 3)


def test_arrows_keep_their_own_colours(client):
    view = CloudsView(client.scene, PALETTE)
    view.show_flow(np.zeros((2, 3)), np.array([[np.nan] * 3, [1, 0, 0]]), 1.0, GREEN)
    assert client.node(f"{FIXED}/flow").colors.tolist() == [[0, 131, 46]]


def test_sizes_follow_the_height_of_the_picture(client):
    view = CloudsView(client.scene, PALETTE)
    view.fit(height=3.0, point_size=0.01)
    source, flow = client.node(f"{FIXED}/source"), client.node(f"{FIXED}/flow")
    assert source.point_size == client.node(f"{FIXED}/target").point_size == 0.015
    shaft = flow.shaft_radius
    view.fit(height=0.3, point_size=0.01)
    assert np.isclose(source.point_size, 0.0015)
    assert np.isclose(flow.shaft_radius, shaft / 10)
