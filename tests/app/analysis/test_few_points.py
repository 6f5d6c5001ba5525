from dataclasses import replace
from typing import Any

import numpy as np

from app.analysis.estimates import Estimates
from app.analysis.few_points import for_few_points, has_too_few_points
from estimator import Parameters
from tests.app.fake_recordings import fake_opened


def of_size(count, parameters) -> Any:
    """Pair of the recording with this many points left, estimated."""
    opened, estimates = fake_opened(), Estimates()
    pair: Any = estimates.estimated(opened, 20, parameters)
    flow = replace(pair.flow, label=pair.flow.label[:count], clusters=())
    return replace(pair, target=replace(pair.target, points=pair.target.points[:count]), flow=flow)


def test_clusters_that_are_too_small_are_known_from_few_points_alone():
    parameters = Parameters()
    assert has_too_few_points(of_size(40, parameters), parameters)
    assert not has_too_few_points(of_size(400, parameters), parameters)
    assert not has_too_few_points(of_size(0, parameters), parameters)
    whole = Estimates().estimated(fake_opened(), 20, parameters)
    assert not has_too_few_points(whole, parameters)
    assert not has_too_few_points(replace(whole, flow=None), parameters)


def test_what_suits_few_points_is_offered_once():
    suited = for_few_points(Parameters(gamma=0.6))
    assert (suited.gamma, suited.n_min, suited.allow_single_cluster) == (0.6, 8, True)
    assert not has_too_few_points(of_size(40, suited), suited)
    assert np.isclose(suited.delta, 0.08)
