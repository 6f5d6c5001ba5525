"""Parameters for clouds of few points, such as those of a single sensor of 8 x 8 zones."""

from collections.abc import Mapping
from types import MappingProxyType
from typing import Any

from app.analysis.pairs import Pair
from estimator import Parameters, changed, find_method

FEW_POINTS: Mapping[str, Any] = MappingProxyType(
    {
        "n": 5,
        "delta": 0.08,
        "n_min": 8,
        "min_cluster_size": 8,
        "allow_single_cluster": True,
        "max_correspondence_distance": 0.25,
    }
)
"""{parameter: value}, chosen on flights with a real VL53L5CX; see docs/real_flights.md."""

_FEW = 200  # points of a cloud


def for_few_points(parameters: Parameters) -> Parameters:
    """The parameters with those values that suit few points."""
    return changed(parameters, FEW_POINTS)


def has_too_few_points(pair: Pair, parameters: Parameters) -> bool:
    """Whether a pair's clusters are too small for parameters that are meant for many points."""
    if pair.flow is None or len(pair.flow.label) == 0 or len(pair.target.points) == 0:
        return False
    uses = find_method(parameters.method).uses
    few = max(len(pair.flow.label), len(pair.target.points)) < _FEW
    small = all(len(c.source) < parameters.n_min > len(c.target) for c in pair.flow.clusters)
    suited = for_few_points(parameters) == parameters
    return few and small and not suited and {"n_min", "min_cluster_size"} <= set(uses)
