import numpy as np

from app.scene.camera import Camera

UP = np.array([0.0, 0.0, 1.0])


def test_a_picture_shows_what_lies_between_its_edges():
    camera = Camera((0.0, 0.0, 0.0), (2.0, 0.0, 0.0), np.pi / 2)
    points = np.array([[1, 0, 0], [1, 1.5, 0], [1, 2.5, 0], [1, 0, 0.9], [1, 0, 1.1], [-1, 0, 0]])
    assert camera.sees(points, UP, 2.0).tolist() == [True, True, False, True, False, False]
    rolled = np.array([0.0, 1.0, 0.0])
    assert camera.sees(points, rolled, 2.0).tolist() == [True, False, False, True, True, False]
