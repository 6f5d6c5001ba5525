from dataclasses import replace

import numpy as np
import pytest

from app.analysis.estimates import Estimates
from app.scene.drawn_flow import moving_ends
from app.scene.first_view import View
from app.scene.lens import Lens
from app.scene.views import ABOVE, FIT, FRONT, SENSORS, SLANTED, Projection, named_view
from estimator import Parameters
from tests.app.fake_recordings import fake_opened

FILM = Projection(np.radians(40), 1.5)


@pytest.fixture(scope="module")
def pair():
    return Estimates().estimated(fake_opened(), 20, Parameters())


def in_picture(view, points, projection=FILM):
    """Whether points (N, 3) are in the picture of a camera with z up."""
    forward = view.look_at - view.position
    forward /= np.linalg.norm(forward)
    right = np.cross(forward, [0.0, 0.0, 1.0])
    right /= np.linalg.norm(right)
    rays, slope = points - view.position, np.tan(projection.fov / 2)
    depth = rays @ forward
    high = np.abs(rays @ np.cross(right, forward)) <= depth * slope
    return high & (np.abs(rays @ right) <= depth * slope * projection.aspect)


@pytest.mark.parametrize(
    ("name", "aspect"),
    [
        (ABOVE, 0.6),
        (ABOVE, 1.5),
        (ABOVE, 2.5),
        (FRONT, 0.6),
        (FRONT, 1.5),
        (FRONT, 2.5),
        (SLANTED, 1.5),
    ],
)
def test_what_moves_is_in_the_picture(pair, name, aspect):
    projection = Projection(FILM.fov, aspect)
    view = named_view(name, pair, np.eye(3), projection)
    moving = pair.source.points[pair.truly_moving]
    assert in_picture(view, moving, projection).mean() > 0.9


@pytest.mark.parametrize("name", [ABOVE, FRONT, SLANTED])
def test_the_ends_of_arrows_are_in_the_picture(pair, name):
    slow, fast = pair, replace(pair, flow=replace(pair.flow, velocity=40 * pair.flow.velocity))
    moving = pair.source.points[pair.flow.moving]
    tips = moving + pair.interval * fast.flow.velocity[pair.flow.moving]
    assert in_picture(named_view(name, slow, np.eye(3), FILM), tips).mean() < 0.1
    view = named_view(name, fast, np.eye(3), FILM)
    assert in_picture(view, tips).mean() > 0.9
    assert in_picture(view, moving).mean() > 0.9


def test_top_looks_down_with_y_up_in_the_picture(pair):
    view = named_view(ABOVE, pair, np.eye(3), FILM)
    way = view.look_at - view.position
    assert way[2] < 0
    np.testing.assert_allclose(way[:2] / way[2], 0.0, atol=2e-3)
    assert way[1] > 0


def test_front_looks_back_along_x(pair):
    view = named_view(FRONT, pair, np.eye(3), FILM)
    np.testing.assert_allclose(view.position[1:], view.look_at[1:])
    assert view.position[0] > view.look_at[0]


def test_from_the_robot_a_sensor_looks_at_what_moves(pair):
    view = named_view(SENSORS, pair, np.eye(3), FILM)
    sensor = pair.target.T_fixed_sensor[0]
    np.testing.assert_allclose(view.position, sensor[:3, 3] + 0.01 * sensor[:3, 2])
    moving = pair.source.points[pair.truly_moving]
    np.testing.assert_allclose(view.look_at, np.median(moving, axis=0))


@pytest.mark.parametrize("moves", [True, False])
def test_fit_shows_what_moves_or_else_all_and_keeps_the_direction(pair, moves):
    before = View(np.array([3.0, 1.0, 2.0]), np.array([0.0, 1.0, 0.0]))
    shown = pair if moves else replace(pair, flow=None)
    view = named_view(FIT, shown, np.eye(3), FILM, before)
    seen = pair.source.points[pair.flow.moving] if moves else pair.target.points
    assert in_picture(view, seen).mean() > 0.95
    assert (in_picture(view, pair.target.points).mean() > 0.95) is not moves
    direction, kept = view.look_at - view.position, before.look_at - before.position
    np.testing.assert_allclose(
        direction / np.linalg.norm(direction), kept / np.linalg.norm(kept), atol=1e-9
    )


def test_from_the_robot_without_motion_the_sensor_that_sees_most_looks_along_its_axis(pair):
    still = replace(pair, flow=None)
    view = named_view(SENSORS, still, np.eye(3), FILM)
    seen = np.bincount(pair.target.sensor)
    sensor = pair.target.T_fixed_sensor[int(seen.argmax())]
    np.testing.assert_allclose(view.position, sensor[:3, 3] + 0.01 * sensor[:3, 2])
    way = view.look_at - view.position
    np.testing.assert_allclose(way / np.linalg.norm(way), sensor[:3, 2], atol=1e-9)


def test_fit_is_as_tight_as_what_moves_is_small(pair):
    narrow, wide = Projection(FILM.fov, 0.5), Projection(FILM.fov, 2.0)
    seen = np.vstack(moving_ends(pair))
    for projection in (narrow, wide):
        view = named_view(FIT, pair, np.eye(3), projection)
        assert in_picture(view, seen, projection).mean() > 0.95
        closer = View(view.look_at + 0.4 * (view.position - view.look_at), view.look_at)
        assert not in_picture(closer, seen, projection).all()


@pytest.mark.parametrize("name", [SENSORS, FIT])
def test_views_turn_with_the_drawing(pair, name):
    turn = np.array([[0.0, -1, 0], [1, 0, 0], [0, 0, 1]])
    before = View(np.array([3.0, 1.0, 2.0]), np.zeros(3))
    turned = View(turn @ before.position, turn @ before.look_at)
    straight = named_view(name, pair, np.eye(3), FILM, before)
    other = named_view(name, pair, turn, FILM, turned)
    np.testing.assert_allclose(other.position, turn @ straight.position, atol=1e-9)


def test_a_near_thing_is_cleared_away_only_where_the_camera_is_far():
    far, close = Lens(4.0, 0.66), Lens(0.3, 0.66)
    assert far.near == pytest.approx(1.8)
    assert close.near == 0.01
    assert far.height / close.height == pytest.approx(4.0 / 0.3)
    assert not far.similar(close)
    assert far.similar(Lens(4.1, 0.66))


@pytest.mark.parametrize("name", [ABOVE, FRONT, SLANTED])
def test_a_true_object_is_in_the_picture_wherever_it_stands(pair, name):
    aside = np.array([[2.0, -3.0, 0.0], [2.5, -2.5, 1.8]])
    assert not in_picture(named_view(name, pair, np.eye(3), FILM), aside).all()
    assert in_picture(named_view(name, pair, np.eye(3), FILM, objects=aside), aside).all()
