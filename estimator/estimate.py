"""The one call that everything else makes."""

from numpy.typing import ArrayLike

from estimator.cloud import CloudPair, HasPoints, cloud_pair
from estimator.flow import SceneFlow
from estimator.methods import method
from estimator.parameters import Parameters


def estimate_scene_flow(
    source: ArrayLike | HasPoints,
    target: ArrayLike | HasPoints,
    interval: float,
    parameters: Parameters,
) -> SceneFlow:
    """Estimate what moved between two clouds, with the method that the parameters name.

    Args:
        source: (N, 3) metres, P_{k-n}, or a cloud of a recording; N may be 0. Points that are not
            finite are Unassigned.
        target: (M, 3) metres, P_k, in the same frame, likewise.
        interval: seconds between the two stamps.
        parameters: thresholds and method; `parameters.n` is not used, the caller chose the pair.

    Returns:
        A label and a velocity for each source point, and the story of each cluster.

    Raises:
        CloudError: a cloud of the wrong shape, or an interval not above zero.
    """
    return estimate_pair(cloud_pair(source, target, interval), parameters)


def estimate_pair(pair: CloudPair, parameters: Parameters) -> SceneFlow:
    """The same for a pair that is estimated again and again, with other parameters.

    What an earlier estimate of the pair found out, and these parameters do not change, is not
    computed again: with other γ, δ and N_min the clustering and all ICP rounds done so far stay.
    """
    return method(parameters.method)(pair, parameters)
