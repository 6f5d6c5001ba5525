import numpy as np
import pytest
import trimesh
from scipy.spatial import KDTree

from recordings.simulation.body import FURTHER, OWN_ROBOT, TARGET
from recordings.simulation.scenario import SCENARIOS
from recordings.simulation.scene import Scene
from recordings.simulation.sensors import PieceCaster
from recordings.simulation.surroundings import surroundings
from robot_assets import load_robot

ROBOT = load_robot()


def test_every_piece_is_closed():
    assert all(piece.mesh.is_volume for piece in surroundings())


def test_there_is_something_within_reach_of_the_sensors_all_around():
    caster = PieceCaster({i: piece.mesh for i, piece in enumerate(surroundings())})
    directions = trimesh.creation.icosphere(subdivisions=3).vertices
    hits = caster.cast(np.tile([0.0, 0.0, 0.8], (len(directions), 1)), np.asarray(directions))
    assert (hits.piece >= 0).all()
    assert (hits.distance < 4.0).mean() > 0.9


def test_without_the_second_robot_its_pedestal_is_not_there():
    everything, less = surroundings(), surroundings(pedestal=False)
    places = {tuple(piece.mesh.bounds[0]) for piece in less}
    gone = [p.mesh.bounds for p in everything if tuple(p.mesh.bounds[0]) not in places]
    assert len(gone) == len(everything) - len(less) == 3
    assert all(low[1] > 1.2 and high[1] < 1.8 for low, high in gone)


def inside(points: np.ndarray, mesh: trimesh.Trimesh) -> np.ndarray:
    low, high = mesh.bounds
    return ((points > low) & (points < high)).all(axis=1)


@pytest.mark.parametrize("name", list(SCENARIOS))
def test_nothing_that_moves_runs_into_the_furniture_or_into_the_robot(name: str):
    scenario = SCENARIOS[name]
    scene = Scene(scenario, scenario.speeds[0], ROBOT, np.zeros(3))
    for time in np.linspace(0.0, scene.duration, 9):
        bodies = scene.bodies(float(time))
        # A robot's first link stands on the furniture.
        firsts = [next((b for b in bodies if b.number == n), None) for n in (OWN_ROBOT, 3)]
        placed = [(body.number, body.posed_mesh()) for body in bodies if body not in firsts]
        for piece in scene.static:
            assert not any(inside(mesh.vertices, piece.mesh).any() for _, mesh in placed)
        own = np.concatenate([mesh.vertices for number, mesh in placed if number == OWN_ROBOT])
        for _, mesh in [(n, m) for n, m in placed if n == TARGET or n >= FURTHER]:
            assert KDTree(mesh.vertices).query(own)[0].min() > 0.1
