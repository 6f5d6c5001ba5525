import numpy as np
import pytest

from recordings.simulation.mannequin import GRIP, mannequin
from robot_assets import RayCaster


def test_every_piece_is_closed_with_its_outside_outside():
    pieces = mannequin().split()
    assert len(pieces) == 5
    for piece in pieces:
        assert piece.is_watertight
        assert piece.is_winding_consistent
        assert piece.volume > 0


def test_it_has_the_size_of_a_person_without_legs():
    low, high = mannequin().bounds
    width, depth, height = high - low
    assert 0.9 < height < 1.05
    assert 0.6 < width < 1.1
    assert 0.2 < depth < 0.35


def test_it_is_the_same_left_and_right():
    vertices = mannequin().vertices
    mirrored = vertices * [-1.0, 1.0, 1.0]
    key = lambda points: np.round(points[np.lexsort(np.round(points, 5).T)], 5)  # noqa: E731
    assert key(mirrored) == pytest.approx(key(vertices), abs=2e-5)


def test_the_grip_is_on_its_back():
    behind = np.array([[GRIP[0], 1.0, GRIP[2]]])
    distance, _ = RayCaster(mannequin()).cast(behind, np.array([[0.0, -1.0, 0.0]]))
    assert 1.0 - distance[0] == pytest.approx(GRIP[1], abs=1e-6)


def test_it_faces_minus_y_with_its_chest_in_front():
    front = np.array([[0.0, -1.0, 0.05]])
    distance, _ = RayCaster(mannequin()).cast(front, np.array([[0.0, 1.0, 0.0]]))
    assert -0.15 < -1.0 + distance[0] < -0.12
