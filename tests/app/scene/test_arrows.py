"""Arrows as lines: where they lie, and in which colours."""

import numpy as np

from app.scene.arrows import Arrows, barbs, linear, shafts

NODE = "/arrows"


def test_heads_point_where_the_arrow_goes_and_are_shorter_than_it():
    segments = np.array([[[0, 0, 0], [1, 0, 0]], [[0, 0, 0], [0, 0, 0.01]]], dtype=float)
    found = barbs(segments, 0.1).reshape(2, -1, 2, 3)
    np.testing.assert_array_equal(found[:, :, 0], np.broadcast_to(segments[:, 1:], (2, 6, 3)))
    np.testing.assert_allclose(found[0, :, 1, 0], 0.9)
    assert (found[1, :, 1, 2] > 0.005).all()
    aside = np.linalg.norm(found[0, :, 1, 1:], axis=1)
    np.testing.assert_allclose(aside, aside[0])
    assert 0.02 < aside[0] < 0.05


def test_a_shaft_leaves_its_point_free_and_ends_where_it_goes():
    segments = np.array([[[0, 0, 0], [1, 0, 0]], [[0, 0, 0], [0.01, 0, 0]]], dtype=float)
    found = shafts(segments, 0.02)
    np.testing.assert_allclose(found[:, 0, 0], [0.02, 0.003])
    np.testing.assert_array_equal(found[:, 1], segments[:, 1])


def test_no_arrow_has_no_head():
    assert barbs(np.zeros((0, 2, 3)), 0.1).shape == (0, 2, 3)
    assert np.isfinite(barbs(np.zeros((1, 2, 3)), 0.1)).all()


def test_shafts_and_heads_have_the_arrows_colour(client):
    arrows = Arrows(client.scene, NODE)
    segments = np.array([[[0, 0, 0], [1, 0, 0]], [[0, 0, 0], [0, 1, 0]]], dtype=float)
    given = np.array([[200, 100, 50], [0, 130, 45]], dtype=np.uint8)
    arrows.show(segments, given)
    first, second = linear(given).tolist()
    shafts, heads = client.node(NODE), client.node(f"{NODE}/heads")
    assert shafts.colors.tolist() == [[first] * 2, [second] * 2]
    assert heads.colors.shape == heads.points.shape
    assert (heads.colors[:6] == first).all()
    assert (heads.colors[6:] == second).all()
    arrows.show(segments[:0], np.zeros((0, 3), dtype=np.uint8))
    assert shafts.points.shape == heads.points.shape == shafts.colors.shape == (0, 2, 3)


def test_sizes_are_in_metres(client):
    arrows = Arrows(client.scene, NODE)
    arrows.show(np.array([[[0, 0, 0], [1, 0, 0]]], dtype=float), np.array([1, 2, 3], np.uint8))
    arrows.fit(0.02, 0.2, gap=0.1)
    assert client.node(NODE).thickness == client.node(f"{NODE}/heads").thickness == 0.02
    np.testing.assert_allclose(client.node(f"{NODE}/heads").points[:, 1, 0], 0.8, rtol=1e-6)
    np.testing.assert_allclose(client.node(NODE).points[0, :, 0], [0.1, 1.0], rtol=1e-6)


def test_light_of_a_colour_is_that_of_the_standard():
    # IEC 61966-2-1: half of the light is 188 of 255, and 10 of 255 is on the straight part.
    assert linear(np.array([0, 10, 188, 255])).tolist() == [0, 1, 128, 255]
