import numpy as np
import pytest
import trimesh

from recordings.simulation.scenario import SCENARIOS
from recordings.simulation.scene import Scene
from recordings.simulation.sensors import PieceCaster
from recordings.simulation.surroundings import surroundings
from robot_assets import load_robot

ROBOT = load_robot()


def test_every_piece_is_closed():
    assert all(piece.is_volume for piece in surroundings())


def test_there_is_something_within_reach_of_the_sensors_all_around():
    caster = PieceCaster(dict(enumerate(surroundings())))
    directions = trimesh.creation.icosphere(subdivisions=3).vertices
    hits = caster.cast(np.tile([0.0, 0.0, 0.8], (len(directions), 1)), np.asarray(directions))
    assert (hits.piece >= 0).all()
    assert (hits.distance < 4.0).mean() > 0.9


@pytest.mark.parametrize("name", list(SCENARIOS))
def test_nothing_that_moves_runs_into_the_furniture_or_into_each_other(name: str):
    scene = Scene(SCENARIOS[name], 0.25, ROBOT, np.zeros(3))
    for time in (0.0, 1.0, 1.3, 1.6, scene.duration):
        bodies = [(body.number, body.placed()) for body in scene.bodies(time)]
        mannequin = bodies[0][1]
        # A robot's first link stands on the furniture, and its second inside the first.
        moving = [mesh for i, (_, mesh) in enumerate(bodies) if i not in (1, 12)]
        assert len(moving) == len(bodies) - 2
        for piece in scene.static:
            low, high = piece.bounds
            for mesh in moving:
                inside = ((mesh.vertices > low) & (mesh.vertices < high)).all(axis=1)
                assert not inside.any()
        own = np.concatenate([mesh.vertices for number, mesh in bodies if number == 2])
        assert np.min(trimesh.proximity.ProximityQuery(mannequin).vertex(own)[0]) > 0.1
