"""Register of methods, and what a method declares."""

from dataclasses import dataclass

import numpy as np
import pytest

from estimator import (
    CheckedParameters,
    CloudError,
    Method,
    MethodError,
    ParameterError,
    Parameters,
    SceneFlow,
    Window,
    changed,
    estimate_scene_flow,
    find_method,
    from_nested,
    method_names,
    parameter,
    register,
    scene_flow_of_points,
    to_nested,
    values_of,
)

pytestmark = pytest.mark.usefixtures("methods_of_a_test")

BEFORE = method_names()
POINTS = np.arange(12.0).reshape(4, 3)


@dataclass(frozen=True)
class Own(CheckedParameters):
    """Parameters of each kind that there is."""

    speed: float = parameter(0.5, text="speed", unit="m/s", low=0.0, high=2.0)
    steps: int = parameter(3, text="steps", low=1, high=9)
    robust: bool = parameter(True, text="whether it is robust")
    kind: str = parameter("fast", text="kind", choices=("fast", "exact"))
    most: int | None = parameter(None, text="most", low=1, high=5)


def flow(window: Window, parameters: Parameters) -> SceneFlow:
    return scene_flow_of_points(np.full((len(window.source.points), 3), parameters.of(Own).speed))


@pytest.fixture
def own():
    method = Method("own", flow, parameters=Own)
    register(method)
    return method


def test_a_registered_method_estimates(own):
    assert method_names() == (*BEFORE, "own")
    assert find_method("own") is own
    found = estimate_scene_flow(POINTS, POINTS, 1.0, Parameters(method="own"))
    assert (found.velocity == 0.5).all()
    assert found.moving.all()


def test_a_methods_own_parameters_reach_it(own):
    parameters = Parameters(method="own", own=(Own(speed=1.5),))
    assert (estimate_scene_flow(POINTS, POINTS, 1.0, parameters).velocity == 1.5).all()


def test_parameters_that_mean_the_same_are_equal(own):
    assert Parameters(method="own", own=(Own(),)) == Parameters(method="own")
    assert hash(Parameters(own=(Own(),))) == hash(Parameters())
    assert Parameters(own=(Own(speed=1.0),)) != Parameters()


def test_values_are_called_by_method_and_name(own):
    values = values_of(changed(Parameters(), {"own.speed": 1.0, "gamma": 0.5}))
    assert values["own.speed"] == 1.0
    assert values["own.steps"] == 3
    assert values["gamma"] == 0.5


def test_nested_values_come_back(own):
    parameters = changed(
        Parameters(method="own"), {"own.kind": "exact", "own.most": 2, "own.robust": False, "n": 3}
    )
    assert to_nested(parameters)["own"] == {
        "speed": 0.5,
        "steps": 3,
        "robust": False,
        "kind": "exact",
        "most": 2,
    }
    assert from_nested(to_nested(parameters)) == parameters


def test_of_other_methods_only_what_was_set_is_kept(own):
    assert "own" not in to_nested(Parameters())
    assert to_nested(changed(Parameters(), {"own.steps": 4}))["own"]["steps"] == 4


@pytest.mark.parametrize(
    ("values", "sentence"),
    [
        ({"own.steps": 2.5}, "own.steps must be a whole number, got 2.5."),
        ({"own.steps": True}, "own.steps must be a whole number, got True."),
        ({"own.robust": 1}, "own.robust must be true or false, got 1."),
        ({"own.speed": 3}, "own.speed must be between 0 and 2 m/s, got 3."),
        ({"own.speed": float("nan")}, "own.speed must be between 0 and 2 m/s, got nan."),
        ({"own.speed": None}, "own.speed must be a number, got None."),
        ({"own.kind": "slow"}, "own.kind must be one of fast, exact, got 'slow'."),
        (
            {"own.slow": 1},
            "own.slow is no parameter; those of own are speed, steps, robust, kind, most.",
        ),
        ({"paper.slow": 1}, "paper.slow is no parameter; paper has none."),
    ],
)
def test_a_value_of_its_own_is_checked_by_its_type(own, values, sentence):
    with pytest.raises(ParameterError) as caught:
        changed(Parameters(), values)
    assert str(caught.value) == sentence


def test_a_method_says_which_parameters_change_its_results(own):
    assert list(own.infos()) == [
        *("n", "max_range"),
        *("own.speed", "own.steps", "own.robust", "own.kind", "own.most"),
    ]
    assert "gamma" in find_method("paper").infos()
    assert "gamma" not in find_method("baseline").infos()
    assert "method" not in find_method("paper").infos()


@pytest.mark.parametrize(
    ("method", "said"),
    [
        (Method("paper", flow), "There is a method paper already"),
        (Method("a b", flow), "A method's name is made of letters"),
        (Method("gamma", flow), "A method's name is made of letters"),
        (Method("neither"), "either a flow or a tracker"),
        (Method("both", flow, tracker=lambda _: None), "either a flow or a tracker"),  # type: ignore[arg-type,return-value]
        (Method("user", flow, uses=("n", "speed")), "uses speed, which is no field"),
    ],
)
def test_what_cannot_be_registered_says_why(method, said):
    with pytest.raises(MethodError, match=said):
        register(method)
    assert method_names() == BEFORE


def test_a_parameter_that_no_control_could_hold_is_refused():
    @dataclass(frozen=True)
    class Wrong(CheckedParameters):
        weights: tuple[float, ...] = parameter((), text="weights")

    with pytest.raises(TypeError, match=r"Wrong\.weights must be int, float, bool or str"):
        Wrong()


def test_a_method_that_needs_rays_refuses_plain_points():
    register(Method("rayed", flow, needs_rays=True))
    with pytest.raises(CloudError, match="looks along the rays of sensors"):
        estimate_scene_flow(POINTS, POINTS, 1.0, Parameters(method="rayed"))


def test_a_tracker_sees_a_single_pair_as_its_first():
    class Counting:
        def __init__(self, parameters: Parameters) -> None:
            self.steps = 0.0

        def step(self, window: Window) -> SceneFlow:
            self.steps += 1
            return scene_flow_of_points(np.full((len(window.source.points), 3), self.steps))

    register(Method("counting", tracker=Counting))
    for _ in range(2):
        found = estimate_scene_flow(POINTS, POINTS, 1.0, Parameters(method="counting"))
        assert (found.velocity == 1).all()


def test_results_cannot_be_written_to():
    steps = np.linspace(0.0, 0.2, 8)
    patch = np.stack(np.meshgrid(steps, steps, [0.0]), axis=-1).reshape(-1, 3)
    cloud = np.vstack([patch, patch + 2.0])
    found = estimate_scene_flow(cloud, cloud + np.array([0.05, 0.0, 0.0]), 1.0, Parameters())
    result = found.clusters[0]
    of_cluster = (result.source, result.remaining, result.velocity)
    of_round = (result.rounds[0].transformation, result.rounds[0].inlier_source)
    for values in (found.label, found.velocity, found.cluster, *of_cluster, *of_round):
        with pytest.raises(ValueError, match="read-only"):
            values[0] = 0


class NoDataclass:
    pass


@dataclass
class NotFrozen(CheckedParameters):
    speed: float = parameter(0.5, text="speed")


@dataclass(frozen=True)
class BadDefault(CheckedParameters):
    speed: float = parameter(0.5, text="speed", high=0.1)


@dataclass(frozen=True)
class SlidingOptional(CheckedParameters):
    most: int | None = parameter(None, text="most", low=1, slider=(1, 5, 1))


@dataclass(frozen=True)
class ZeroOptional(CheckedParameters):
    most: int | None = parameter(None, text="most", low=0)


@pytest.mark.parametrize(
    ("declared", "said"),
    [
        (NoDataclass, "must be a dataclass derived from CheckedParameters"),
        (NotFrozen, "must be frozen"),
        (BadDefault, "speed must be between -inf and 0.1, got 0.5"),
        (SlidingOptional, "most may be unset, and so has no slider"),
        (ZeroOptional, "its range must begin above 0"),
    ],
)
def test_own_parameters_that_would_fail_later_are_refused_at_once(declared, said):
    with pytest.raises(MethodError, match=said):
        register(Method("wrong", flow, parameters=declared))
    assert method_names() == BEFORE


def test_names_and_parameters_are_a_methods_own(own):
    with pytest.raises(MethodError, match="flags of method Own"):
        register(Method("Own", flow))
    with pytest.raises(MethodError, match="are another method's"):
        register(Method("second", flow, parameters=Own))


@pytest.mark.parametrize(
    ("returned", "said"),
    [
        (None, "must return a SceneFlow, got <class 'NoneType'>"),
        (scene_flow_of_points(np.zeros((3, 3))), "of 4 source points, got the shapes"),
    ],
)
def test_a_method_that_gives_no_flow_of_the_source_says_so(returned, said):
    register(Method("wrong", lambda window, parameters: returned))
    with pytest.raises(MethodError, match=said):
        estimate_scene_flow(POINTS, POINTS, 1.0, Parameters(method="wrong"))


@pytest.mark.parametrize("own_values", [(5,), "ab", (object(),)])
def test_own_holds_parameters_of_methods_alone(own_values):
    with pytest.raises(ParameterError, match="own must hold parameters of methods"):
        Parameters(own=own_values)


def test_a_method_that_is_no_text_is_refused():
    with pytest.raises(ParameterError, match="method must be one of"):
        Parameters(method=["paper"])  # type: ignore[arg-type]
