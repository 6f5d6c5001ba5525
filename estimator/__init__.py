"""Scene flow estimation: Algorithm 1, its baseline, and error metrics.

Arrays in, results out; no file, viewer or command line.
"""

from estimator import methods as _built_in  # noqa: F401 (registers the built-in methods)
from estimator.cloud import Cloud, CloudError, PlainCloud
from estimator.engines import ENGINES, Engine, current_engine, use_engine
from estimator.estimate import checked_flow, estimate, estimate_scene_flow
from estimator.flow import (
    ClusterResult,
    IcpRound,
    Label,
    SceneFlow,
    StoryRow,
    scene_flow_of_points,
)
from estimator.method import Method, MethodError, Tracker, all_methods, find_method, register
from estimator.metric_info import MetricInfo
from estimator.metrics import ERROR_SYMBOLS, METRIC_INFO, Metrics, PooledErrors
from estimator.parameter_info import CheckedParameters, ParameterError, ParameterInfo, parameter
from estimator.parameter_values import changed, from_nested, to_nested, values_of
from estimator.parameters import PARAMETER_INFO, Parameters, method_names
from estimator.point_errors import MOVING_SPEED, angles_deg, truly_moves
from estimator.stages import Stages
from estimator.window import LazyFrames, Window, window_of_pair

__all__ = [
    "ENGINES",
    "ERROR_SYMBOLS",
    "METRIC_INFO",
    "MOVING_SPEED",
    "PARAMETER_INFO",
    "CheckedParameters",
    "Cloud",
    "CloudError",
    "ClusterResult",
    "Engine",
    "IcpRound",
    "Label",
    "LazyFrames",
    "Method",
    "MethodError",
    "MetricInfo",
    "Metrics",
    "ParameterError",
    "ParameterInfo",
    "Parameters",
    "PlainCloud",
    "PooledErrors",
    "SceneFlow",
    "Stages",
    "StoryRow",
    "Tracker",
    "Window",
    "all_methods",
    "angles_deg",
    "changed",
    "checked_flow",
    "current_engine",
    "estimate",
    "estimate_scene_flow",
    "find_method",
    "from_nested",
    "method_names",
    "parameter",
    "register",
    "scene_flow_of_points",
    "to_nested",
    "truly_moves",
    "use_engine",
    "values_of",
    "window_of_pair",
]
