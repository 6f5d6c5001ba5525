from functools import cache

import numpy as np
import pytest

from recordings.simulation.body import OWN_ROBOT, SECOND_ROBOT, TARGET
from recordings.simulation.scenario import PAPER_SCENARIOS, SCENARIOS
from recordings.simulation.scene import Scene
from robot_assets import load_robot

ROBOT = load_robot()
OFFSET = np.array([0.01, -0.005, 0.002])


@pytest.fixture(scope="module", params=PAPER_SCENARIOS)
def scene(request: pytest.FixtureRequest) -> Scene:
    return Scene(SCENARIOS[request.param], 0.2, ROBOT, OFFSET)


def test_bodies_are_the_mannequin_and_both_robots(scene: Scene):
    numbers = [body.number for body in scene.bodies(0.0)]
    links = len(ROBOT.collision_meshes)
    assert numbers == [TARGET, *[OWN_ROBOT] * links, *range(SECOND_ROBOT, SECOND_ROBOT + links)]


def test_velocities_are_the_derivatives_of_where_points_are(scene: Scene):
    step = 1e-3
    for time in (0.3, 1.0, 1.5):
        moments = zip(*(scene.bodies(t) for t in (time - step, time, time + step)), strict=True)
        for before, now, after in moments:
            points = now.mesh.vertices[::50]
            place = [points @ b.T_fixed_body[:3, :3].T + b.T_fixed_body[:3, 3] for b in
                     (before, now, after)]  # fmt: skip
            derivative = (place[2] - place[0]) / (2 * step)
            assert now.velocity(place[1]) == pytest.approx(derivative, abs=2e-4)


def test_the_mannequin_is_in_pure_translation(scene: Scene):
    start, end = scene.target(0.0).T_fixed_body, scene.target(scene.duration).T_fixed_body
    assert start[:3, :3] == pytest.approx(np.eye(3))
    assert end[:3, :3] == pytest.approx(np.eye(3))
    assert np.linalg.norm(end - start) == pytest.approx(
        0.25 if scene.target(1.0).rate[:3, 3][0] > 0 else 0.30
    )
    assert np.linalg.norm(scene.target(1.0).rate[:3, 3]) == pytest.approx(0.2)


def test_the_second_robot_holds_the_mannequin_all_the_time(scene: Scene):
    hand = list(ROBOT.collision_meshes).index("panda_hand")
    holding: list[np.ndarray] = []
    for time in (0.0, 1.0, 1.5, scene.duration):
        mannequin = scene.bodies(time)[0]
        second = next(b for b in scene.bodies(time) if b.number == SECOND_ROBOT + hand)
        holding.append(second.T_fixed_body[:3, 3] - mannequin.T_fixed_body[:3, 3])
        assert second.velocity(second.T_fixed_body[:3, 3][None])[0] == pytest.approx(
            scene.target(time).rate[:3, 3], abs=2e-3
        )
    assert np.ptp(holding, axis=0) == pytest.approx(np.zeros(3), abs=5e-5)


@pytest.mark.parametrize("name", PAPER_SCENARIOS)
@pytest.mark.parametrize("corner", [(-1, -1, -1), (1, 1, 1), (-1, 1, -1), (1, -1, 1)])
def test_the_second_robot_reaches_wherever_a_trial_starts(name: str, corner: tuple[int, int, int]):
    offset = 0.015 * np.array(corner)
    scene = Scene(SCENARIOS[name], 0.3, ROBOT, offset)
    shift = scene.target(0.0).T_fixed_body[:3, 3] - nominal_start(name)
    assert shift == pytest.approx(offset)


@cache
def nominal_start(name: str) -> np.ndarray:
    return Scene(SCENARIOS[name], 0.3, ROBOT, np.zeros(3)).target(0.0).T_fixed_body[:3, 3]
