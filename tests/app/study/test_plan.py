from dataclasses import replace
from pathlib import Path

from app.study.plan import Plan
from app.study.work import Recorded, Simulated
from estimator import Parameters
from recordings.simulation import IMPERFECTIONS, NOISE_MODELS, SCENARIOS

PLAN = Plan(Parameters(gamma=0.6))


def simulated(plan: Plan) -> list[Simulated]:
    return [work.source for work in plan.works() if isinstance(work.source, Simulated)]


def test_by_default_these_are_the_papers_sixty_recordings():
    works = PLAN.works()
    assert len(works) == len(set(simulated(PLAN))) == 60
    assert {source.scenario for source in simulated(PLAN)} == {
        "towards",
        "sideways",
        "robot_moving",
    }
    assert {source.speed for source in simulated(PLAN)} == {0.15, 0.20, 0.25, 0.30}
    assert [case.parameters.method for case in works[0].cases] == ["paper", "baseline"]
    assert len(works[0].wanted("towards")) == 20
    assert len(works[0].wanted("sideways")) == 2
    assert {case.parameters.gamma for case in works[0].wanted("towards")} == {0.6}


def test_every_scenario_has_its_own_speeds_unless_others_are_asked_for():
    plan = replace(PLAN, scenarios=tuple(SCENARIOS), trials=(1,))
    for name, scenario in SCENARIOS.items():
        speeds = [source.speed for source in simulated(plan) if source.scenario == name]
        assert speeds == list(scenario.speeds)
    asked = simulated(replace(plan, speeds=(0.4,)))
    assert {source.speed for source in asked if not SCENARIOS[source.scenario].still} == {0.4}
    assert {source.speed for source in asked if SCENARIOS[source.scenario].still} == {0.0}


def test_the_ablation_switches_one_thing_at_a_time():
    plan = replace(PLAN, ablation=True)
    conditions = plan.conditions()
    assert len(conditions) == len(NOISE_MODELS) + len(IMPERFECTIONS)
    assert all(len(imperfections) <= 1 for _, imperfections in conditions)
    assert {noise for noise, imperfections in conditions if imperfections} == {"paper"}
    extra = set(simulated(plan)) - set(simulated(PLAN))
    # The condition without anything else is that of the tables, and simulated once.
    assert len(extra) == 3 * (len(conditions) - 1)
    assert len(plan.works()) == len(set(simulated(plan)))
    assert {(source.scenario, source.speed) for source in extra} == {("towards", 0.20)}


def test_recordings_take_the_place_of_simulated_ones():
    recorded = Recorded(Path("a.mcap"))
    plan = replace(PLAN, recordings=(recorded,))
    (work,) = plan.works()
    assert work.source == recorded
    assert len(work.wanted(None)) == 2
    assert len(work.wanted("towards")) == 20
