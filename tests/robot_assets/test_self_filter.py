"""The robot's own body is taken out of the readings, and nothing else is."""

import numpy as np
import pytest

from robot_assets import RayCaster, Robot, SelfFilter, SensorModel, load_rig, load_robot
from robot_assets.rig import look
from tests.robot_assets.urdf import LINK, box_link, joint, urdf

MODEL = SensorModel()
X, Z = np.array([1.0, 0.0, 0.0]), np.array([0.0, 0.0, 1.0])
SENSOR = look(np.zeros(3), X, Z)[None]  # at the origin, looking along x
READY = {
    f"panda_joint{i}": q
    for i, q in enumerate([0, -np.pi / 4, 0, -3 * np.pi / 4, 0, np.pi / 2, np.pi / 4], start=1)
}


def shows(robot: Robot, depth: float, model: SensorModel = MODEL, **positions: float) -> np.ndarray:
    """Zones (8, 8) of a sensor at the origin that show the robot if all read `depth` metres."""
    ranges = np.full((1, 8, 8), depth)
    poses = robot.link_poses(positions)
    return SelfFilter(robot, model.directions[None]).shows_robot(ranges, SENSOR, poses)[0]


@pytest.fixture(scope="module")
def wall() -> Robot:
    """A robot that fills the field of view, its face 1 m from the sensor."""
    return load_robot(urdf(box_link("body", (1, 9, 9), (1.5, 0, 0))))


@pytest.mark.parametrize(
    ("depth", "is_body"),
    [(0.5, False), (0.96, False), (0.98, True), (1.0, True), (1.04, True), (4.0, True)],
)
def test_at_the_body_and_behind_it_is_body_and_in_front_is_not(wall, depth, is_body):
    assert (shows(wall, depth) == is_body).all()


def test_a_radial_reading_is_compared_along_the_ray(wall):
    radial = SensorModel(distance="radial")
    at_the_wall = np.linalg.norm(MODEL.directions, axis=-1)
    robot_filter, poses = SelfFilter(wall, radial.directions[None]), wall.link_poses({})
    for factor, is_body in ((0.9, False), (1.0, True)):
        ranges = factor * at_the_wall[None]
        found = robot_filter.shows_robot(ranges, SENSOR, poses)
        assert (found == is_body).all()


def test_beside_the_body_nothing_is_taken():
    # The face spans the left half: y above 0 is left when looking along x.
    left = load_robot(urdf(box_link("body", (1, 9, 9), (1.5, 4.5, 0))))
    found = shows(left, 2.0)
    assert found[:, :4].all()
    assert not found[:, 4:].any()


def test_a_zone_that_the_body_only_reaches_into_is_taken():
    # 30 % of column 4's width: its centre ray passes beside the body.
    step = MODEL.directions[0, 1, 0] - MODEL.directions[0, 0, 0]
    edge = -0.3 * step
    reaching = load_robot(urdf(box_link("body", (1, 9, 9), (1.5, 4.5 + edge, 0))))
    found = shows(reaching, 2.0)
    assert found[:, 4].all()
    assert not found[:, 5:].any()


def test_the_body_is_where_the_joints_put_it():
    robot = load_robot(
        urdf(
            LINK.format("base"),
            box_link("arm", (0.2, 9, 9), (1.1, 0, 0)),
            joint("turn", "base", "arm", "continuous"),
        )
    )
    assert shows(robot, 2.0, turn=0.0).all()
    assert not shows(robot, 2.0, turn=np.pi).any()


def test_a_sensor_inside_the_mesh_of_its_own_link_sees_out():
    robot = load_robot(urdf(box_link("mount", (0.4, 0.4, 0.4))))
    assert not shows(robot, 2.0).any()


def test_invalid_readings_show_nothing(wall):
    assert not shows(wall, np.nan).any()


def test_a_robot_without_a_body_hides_nothing():
    assert not shows(load_robot(urdf(LINK.format("base"))), 2.0).any()


def panda_view() -> tuple[Robot, np.ndarray, np.ndarray, np.ndarray]:
    """The Panda, and in its ready pose each zone's direction, sensor pose and depth to the body."""
    robot, rig = load_robot(), load_rig()
    poses = robot.link_poses(READY)
    T = np.array([poses[s.link] @ s.T_link_sensor for s in rig.sensors])
    directions = np.broadcast_to(rig.model.directions, (24, 8, 8, 3))
    depth = np.full((24, 8, 8), np.inf)
    for link, mesh in robot.collision_meshes.items():
        caster = RayCaster(mesh.copy().apply_transform(poses[link]))
        rays = np.einsum("sij,srcj->srci", T[:, :3, :3], directions).reshape(-1, 3)
        lengths = np.linalg.norm(rays, axis=1)
        origins = np.repeat(T[:, :3, 3], 64, axis=0)
        distance, _ = caster.cast(origins, rays / lengths[:, None])
        depth = np.minimum(depth, (distance / lengths).reshape(24, 8, 8))
    return robot, directions, T, depth


def test_the_panda_sees_itself_and_keeps_what_is_in_front_of_it():
    robot, directions, T, depth = panda_view()
    body = np.isfinite(depth)
    assert 20 < body.sum() < 24 * 64 / 2, "some zones see the arm, most look past it"
    robot_filter, poses = SelfFilter(robot, directions), robot.link_poses(READY)

    own = np.where(body, depth, np.nan)
    assert robot_filter.shows_robot(own, T, poses)[body].all()

    # Half-way to the body, and far enough from it that no margin is touched: an object.
    clear = body & (depth > 0.3)
    assert clear.any()
    in_front = np.where(clear, 0.5 * depth, np.nan)
    assert not robot_filter.shows_robot(in_front, T, poses)[clear].any()


def test_most_of_the_pandas_zones_are_free():
    robot, directions, T, _ = panda_view()
    far = SelfFilter(robot, directions).shows_robot(
        np.full((24, 8, 8), 3.9), T, robot.link_poses(READY)
    )
    assert far.mean() < 0.4
    assert all(not sensor.all() for sensor in far), "no sensor is blind"
