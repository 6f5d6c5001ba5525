import numpy as np

from app.scene.clouds_view import CloudsView, arrows
from app.scene.stage import FIXED


def test_arrows_leave_out_what_cannot_be_drawn():
    points = np.array([[0, 0, 0], [1, 0, 0], [2, 0, 0], [np.nan, 0, 0]], dtype=float)
    velocity = np.array([[0, 0.2, 0], [np.nan] * 3, [0, 0, 0], [0, 1, 0]])
    np.testing.assert_allclose(arrows(points, velocity, 0.5), [[[0, 0, 0], [0, 0.1, 0]]])


def test_heads_are_shorter_than_the_shortest_arrow(client):
    view = CloudsView(client.scene, 0.004)
    view.show_flow(np.zeros((2, 3)), np.array([[0.01, 0, 0], [1, 0, 0]]), 1.0)
    node = client.node(f"{FIXED}/flow")
    assert node.points.shape == (2, 2, 3)
    assert 0 < node.head_length < 0.01
    view.show_flow(np.zeros((1, 3)), np.array([[1.0, 0, 0]]), 1.0)
    assert 0.01 < node.head_length <= 0.03


def test_no_flow_draws_no_arrow(client):
    view = CloudsView(client.scene, 0.004)
    view.show_flow(np.zeros((1, 3)), np.ones((1, 3)), 1.0)
    view.show_flow(np.zeros((1, 3)), np.full((1, 3), np.nan), 1.0)
    assert client.node(f"{FIXED}/flow").points.shape == (0, 2, 3)


def test_truth_is_one_arrow_or_none(client):
    view = CloudsView(client.scene, 0.004)
    node = client.node(f"{FIXED}/truth")
    view.show_truth(np.array([1.0, 2, 3]), np.array([0, 0, 0.2]), 0.5)
    np.testing.assert_allclose(node.points, [[[1, 2, 3], [1, 2, 3.1]]], atol=1e-6)
    view.show_truth(np.zeros(3), None, 0.5)
    assert node.points.shape == (0, 2, 3)
