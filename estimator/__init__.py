"""What moved: Algorithm 1, its baseline, and how far they are from the truth.

Arrays in, results out: nothing here knows a file, a viewer or a command line.
"""

from estimator.cloud import CloudError, CloudPair, cloud_pair
from estimator.estimate import estimate_pair, estimate_scene_flow
from estimator.flow import ClusterResult, IcpRound, Label, SceneFlow
from estimator.methods import method_names
from estimator.metrics import MOVING_SPEED, Metrics, PooledErrors, angles_deg
from estimator.parameters import PARAMETER_INFO, ParameterError, ParameterInfo, Parameters

__all__ = [
    "MOVING_SPEED",
    "PARAMETER_INFO",
    "CloudError",
    "CloudPair",
    "ClusterResult",
    "IcpRound",
    "Label",
    "Metrics",
    "ParameterError",
    "ParameterInfo",
    "Parameters",
    "PooledErrors",
    "SceneFlow",
    "angles_deg",
    "cloud_pair",
    "estimate_pair",
    "estimate_scene_flow",
    "method_names",
]
