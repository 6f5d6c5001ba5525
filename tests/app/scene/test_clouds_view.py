import numpy as np

from app.scene.arrows import linear
from app.scene.clouds_view import CloudsView, arrows
from app.scene.drawn_flow import DrawnFlow
from app.scene.palettes import PAPER, palette
from app.scene.scene_root import FIXED

PALETTE = palette(PAPER, dark=False)
GREEN = np.array([[0, 130, 45], [0, 131, 46]], dtype=np.uint8)


def test_arrows_leave_out_what_cannot_be_drawn():
    points = np.array([[0, 0, 0], [1, 0, 0], [2, 0, 0], [np.nan, 0, 0]], dtype=float)
    displacement = np.array([[0, 0.1, 0], [np.nan] * 3, [0, 0, 0], [0, 1, 0]])
    np.testing.assert_allclose(arrows(points, displacement), [[[0, 0, 0], [0, 0.1, 0]]])


def test_no_flow_draws_no_arrow(client):
    view = CloudsView(client.scene)
    view.show_flow(DrawnFlow(np.zeros((1, 3)), np.ones((1, 3)), GREEN[:1]))
    view.show_flow(DrawnFlow(np.zeros((1, 3)), np.full((1, 3), np.nan), GREEN[:1]))
    assert client.node(f"{FIXED}/flow").points.shape == (0, 2, 3)


def test_truth_is_one_arrow_or_none(client):
    view = CloudsView(client.scene)
    node = client.node(f"{FIXED}/truth")
    view.show_truth(np.array([1.0, 2, 3]), np.array([0, 0, 0.1]), PALETTE.truth)
    np.testing.assert_allclose(node.points, [[[1, 2, 3], [1, 2, 3.1]]], atol=1e-6)
    assert node.colors.tolist() == [[linear(np.array(PALETTE.truth)).tolist()] * 2]
    view.show_truth(np.zeros(3), None, PALETTE.truth)
    assert node.points.shape == (0, 2, 3)


def test_arrows_keep_their_own_colours(client):
    view = CloudsView(client.scene)
    view.show_flow(DrawnFlow(np.zeros((2, 3)), np.array([[np.nan] * 3, [1, 0, 0]]), GREEN))
    assert client.node(f"{FIXED}/flow").colors.tolist() == [[linear(GREEN[1]).tolist()] * 2]


def test_what_moves_is_drawn_apart_from_what_does_not(client):
    view = CloudsView(client.scene)
    points, moving = np.arange(6.0).reshape(2, 3), np.array([True, False])
    view.source.show(points, GREEN, moving)
    view.target.show(points, GREEN, ~moving)
    for node, row in (("source", 0), ("static_source", 1), ("target", 1), ("static_target", 0)):
        assert client.node(f"{FIXED}/{node}").points.tolist() == [points[row].tolist()]
        assert client.node(f"{FIXED}/{node}").colors.tolist() == [GREEN[row].tolist()]


def test_sizes_follow_the_height_of_the_picture(client):
    view = CloudsView(client.scene)
    view.size_static(0.5)
    view.fit(height=3.0, point_size=0.01)
    source, flow = client.node(f"{FIXED}/source"), client.node(f"{FIXED}/flow")
    size, thickness = source.point_size, flow.thickness
    assert client.node(f"{FIXED}/target").point_size == size >= 0.015
    assert client.node(f"{FIXED}/static_target").point_size == size / 2
    view.fit(height=0.3, point_size=0.01)
    assert np.isclose(source.point_size, size / 10)
    assert np.isclose(client.node(f"{FIXED}/static_source").point_size, size / 20)
    assert np.isclose(flow.thickness, thickness / 10)
