import numpy as np
import pytest
import trimesh

from recordings.simulation.sensors import PieceCaster, ZoneRays
from robot_assets import Rig, Sensor, SensorModel


def rig(model: SensorModel) -> Rig:
    return Rig("one", model, (Sensor("eye", "", "base", np.eye(4)),))


def wall(distance: float, left: float = -9.0, right: float = 9.0) -> trimesh.Trimesh:
    """A plate across the optical axis z, from `left` to `right` along x."""
    plate = trimesh.creation.box((right - left, 18.0, 0.1))
    plate.apply_translation(((left + right) / 2, 0.0, distance + 0.05))
    return plate


def read(
    pieces: dict[int, trimesh.Trimesh],
    model: SensorModel | None = None,
    pose: np.ndarray | None = None,
) -> tuple[np.ndarray, np.ndarray]:
    rays = ZoneRays(rig(model or SensorModel()))
    hits = PieceCaster(pieces).cast(*rays.in_fixed(np.eye(4)[None] if pose is None else pose))
    seen = rays.seen(hits)
    return seen.distance[0], seen.piece[0]


def test_a_wall_straight_ahead_has_one_perpendicular_distance():
    readings, piece = read({7: wall(1.3)})
    assert readings == pytest.approx(np.full((8, 8), 1.3), abs=1e-5)
    assert (piece == 7).all()


def test_a_radial_sensor_reads_along_the_rays_of_its_zones():
    model = SensorModel(distance="radial")
    readings, _ = read({0: wall(1.3)}, model)
    lengths = np.linalg.norm(SensorModel().directions, axis=-1)
    assert readings == pytest.approx(1.3 * lengths, abs=1e-5)


def test_a_slanted_wall_is_read_at_the_middle_of_each_zone():
    plate = wall(0.0)
    plate.apply_transform(trimesh.transformations.rotation_matrix(0.5, (0, 1, 0)))
    plate.apply_translation((0, 0, 1.0))
    readings, _ = read({0: plate})
    columns = SensorModel().directions[0, :, 0]
    exact = 1.0 / (1.0 + np.tan(0.5) * columns)
    assert readings == pytest.approx(np.tile(exact, (8, 1)), rel=3e-3)


@pytest.mark.parametrize(("share", "seen"), [(0.3, 2), (0.8, 1)])
def test_a_zone_reads_what_fills_most_of_it(share: float, seen: int):
    column = 3
    model = SensorModel()
    left = 1.0 * (column - 4) / model.focal_length
    edge = left + share / model.focal_length
    readings, piece = read({1: wall(1.0, -9.0, edge), 2: wall(2.0)})
    assert (piece[:, :column] == 1).all()
    assert (piece[:, column] == seen).all()
    assert (piece[:, column + 1 :] == 2).all()
    assert readings[:, column] == pytest.approx(np.full(8, float(seen)), abs=1e-5)


def test_two_that_fill_as_much_read_as_the_nearer():
    _, piece = read({1: wall(2.0), 2: wall(1.0, -9.0, 0.5 / SensorModel().focal_length)})
    assert (piece[:, 4] == 2).all()


def test_the_sensor_sees_along_its_own_axes_from_its_own_place():
    pose = np.eye(4)
    pose[:3, :3] = trimesh.transformations.euler_matrix(0.3, -0.8, 1.1)[:3, :3]
    pose[:3, 3] = (0.4, -0.2, 0.9)
    readings, _ = read({0: wall(0.7).apply_transform(pose)}, pose=pose[None])
    assert readings == pytest.approx(np.full((8, 8), 0.7), abs=1e-5)


def test_nothing_ahead_reads_as_nothing():
    readings, piece = read({0: wall(-2.0)})
    assert np.isinf(readings).all()
    assert (piece == -1).all()


@pytest.mark.parametrize("distance", ["perpendicular", "radial"])
def test_a_zone_across_a_step_sees_what_is_in_front_and_what_is_behind(distance: str):
    column = 3
    model = SensorModel(distance=distance)  # type: ignore[arg-type]
    edge = (column - 4 + 0.6) / model.focal_length
    rays = ZoneRays(rig(model))
    hits = PieceCaster({1: wall(1.0, -9.0, edge), 2: wall(2.0)}).cast(
        *rays.in_fixed(np.eye(4)[None])
    )
    edges, seen = rays.edges(hits), rays.seen(hits)
    assert edges.step[0, :, column].all()
    assert edges.step.sum() == 8
    assert (edges.front.piece[edges.step] == 1).all()
    assert (edges.behind.piece[edges.step] == 2).all()
    front, behind = edges.front.distance[edges.step], edges.behind.distance[edges.step]
    lengths = np.linalg.norm(SensorModel().directions, axis=-1)[:, column]
    scale = lengths if distance == "radial" else np.ones(8)
    # Some rays meet the side of the plate in front, which is 0.1 m thick.
    assert front == pytest.approx(1.0 * scale, rel=0.04)
    assert behind == pytest.approx(2.0 * scale, rel=0.04)
    assert (seen.piece[edges.step] == 1).all()


def test_a_small_step_is_none():
    rays = ZoneRays(rig(SensorModel()))
    pieces = {1: wall(1.0, -9.0, -0.06), 2: wall(1.5)}
    hits = PieceCaster(pieces).cast(*rays.in_fixed(np.eye(4)[None]))
    assert not rays.edges(hits).step.any()
