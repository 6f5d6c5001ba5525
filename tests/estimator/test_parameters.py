"""One definition of the parameters: defaults, ranges, sentences."""

import json
import math
from dataclasses import FrozenInstanceError, asdict, fields
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from estimator import PARAMETER_INFO, ParameterError, Parameters, method_names

NUMBERS = [name for name, info in PARAMETER_INFO.items() if math.isfinite(info.low)]
INTEGERS = [name for name, info in PARAMETER_INFO.items() if info.kind is int]


def with_value(name: str, value: Any) -> Parameters:
    return Parameters(**{name: value})


def test_defaults_are_the_papers():
    parameters = Parameters()
    assert (parameters.n, parameters.gamma, parameters.delta, parameters.n_min) == (
        8,
        0.7,
        0.04,
        60,
    )
    assert parameters.method == "paper"


def test_defaults_the_paper_leaves_open():
    parameters = Parameters()
    assert parameters.min_cluster_size == 20
    assert parameters.min_samples is None
    assert parameters.allow_single_cluster is False
    assert parameters.max_correspondence_distance == 0.10
    assert parameters.max_range == 4.0


def test_every_field_is_described():
    assert list(PARAMETER_INFO) == [f.name for f in fields(Parameters) if f.name != "own"]
    for name, info in PARAMETER_INFO.items():
        assert info.text, name
        assert not info.text.endswith("."), f"{name}: the sentence goes on in help texts"


@pytest.mark.parametrize("name", ["n", "gamma", "delta", "n_min"])
def test_sliders_stay_within_the_range_and_show_the_default(name):
    info, default = PARAMETER_INFO[name], getattr(Parameters(), name)
    assert info.slider is not None
    low, high, step = info.slider
    assert info.low <= low < high <= info.high
    assert low <= default <= high
    assert (default - low) / step == pytest.approx(round((default - low) / step))


def test_parameters_cannot_be_changed():
    with pytest.raises(FrozenInstanceError):
        Parameters().gamma = 0.5  # type: ignore[misc]


@pytest.mark.parametrize("name", NUMBERS)
def test_both_ends_of_a_range_are_accepted(name):
    info = PARAMETER_INFO[name]
    kind = int if name in INTEGERS else float
    for value in (kind(info.low), kind(info.high)):
        assert getattr(with_value(name, value), name) == value


@pytest.mark.parametrize("name", NUMBERS)
def test_beyond_either_end_is_one_sentence_that_names_it(name):
    info = PARAMETER_INFO[name]
    for value in (info.low - 1, info.high + 1):
        wrong = int(value) if name in INTEGERS else value
        with pytest.raises(ParameterError) as caught:
            with_value(name, wrong)
        sentence = str(caught.value)
        assert sentence.startswith(f"{name} must be between ")
        assert repr(wrong) in sentence
        assert sentence.endswith(".")
        assert "\n" not in sentence


@pytest.mark.parametrize("name", NUMBERS)
@pytest.mark.parametrize("value", ["8", [8], True, math.nan, {}])
def test_a_wrong_type_is_refused(name, value):
    with pytest.raises(ParameterError, match=f"^{name} must be "):
        with_value(name, value)


@pytest.mark.parametrize("name", INTEGERS)
def test_whole_numbers_are_whole(name):
    with pytest.raises(ParameterError, match=f"^{name} must be a whole number, got 8.0"):
        with_value(name, 8.0)


@pytest.mark.parametrize(
    ("name", "value"),
    [
        ("n", np.int64(6)),
        ("n_min", np.uint8(20)),
        ("gamma", np.float32(0.5)),
        ("delta", np.float64(0.25)),
        ("delta", np.int32(1)),
        ("allow_single_cluster", np.bool_(True)),
        ("method", np.str_("baseline")),
    ],
)
def test_values_of_numpy_become_pythons(name, value):
    parameters = with_value(name, value)
    assert type(getattr(parameters, name)) is PARAMETER_INFO[name].kind
    assert parameters == with_value(name, value.item())
    assert json.loads(json.dumps(asdict(parameters)))[name] == value


@pytest.mark.parametrize(
    ("name", "value"),
    [("n", np.float64(6)), ("gamma", np.bool_(True)), ("n", np.int64(0)), ("n", np.array([6]))],
)
def test_values_of_numpy_are_checked_as_others_are(name, value):
    with pytest.raises(ParameterError, match=f"^{name} must be "):
        with_value(name, value)


@pytest.mark.parametrize("name", [n for n in NUMBERS if n != "min_samples"])
def test_only_min_samples_may_be_unset(name):
    with pytest.raises(ParameterError, match=f"^{name} must be "):
        with_value(name, None)


@pytest.mark.parametrize("value", [0, 1, "yes", None])
def test_allow_single_cluster_is_true_or_false(value):
    with pytest.raises(ParameterError, match="allow_single_cluster must be true or false"):
        Parameters(allow_single_cluster=value)


@pytest.mark.parametrize("value", ["Paper", "", None, 1])
def test_an_unknown_method_lists_the_known_ones(value):
    with pytest.raises(ParameterError, match=r"method must be one of paper, baseline"):
        Parameters(method=value)


@pytest.mark.parametrize("name", method_names())
def test_every_registered_method_is_accepted(name):
    assert Parameters(method=name).method == name


@given(gamma=st.floats(), delta=st.floats(), n=st.integers())
def test_a_parameter_is_in_range_or_refused(gamma, delta, n):
    try:
        parameters = Parameters(gamma=gamma, delta=delta, n=n)
    except ParameterError:
        assert not (0 <= gamma <= 1 and 0 <= delta <= 10 and 1 <= n <= 1000)
    else:
        assert 0 <= parameters.gamma <= 1
        assert 0 <= parameters.delta <= 10
        assert 1 <= parameters.n <= 1000
