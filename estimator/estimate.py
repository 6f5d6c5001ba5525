"""Scene flow of a pair of clouds or of a window of frames."""

import numpy as np
from numpy.typing import ArrayLike

from estimator.cloud import CloudError, HasPoints
from estimator.flow import SceneFlow
from estimator.method import Method, MethodError, find_method
from estimator.parameters import Parameters
from estimator.window import Window, window_of_pair


def estimate_scene_flow(
    source: ArrayLike | HasPoints,
    target: ArrayLike | HasPoints,
    interval: float,
    parameters: Parameters,
) -> SceneFlow:
    """Estimate the scene flow between two clouds with the method that the parameters name.

    Args:
        source: (N, 3) metres, P_{k-n}, or a cloud of a recording; N may be 0. Points that are not
            finite are Unassigned.
        target: (M, 3) metres, P_k, in the same frame, likewise.
        interval: seconds between the two stamps.
        parameters: thresholds and method; `parameters.n` is ignored, the pair is given.

    Returns:
        A label and a velocity for each source point, and a result for each cluster.

    Raises:
        CloudError: a cloud has the wrong shape, the interval is not above zero, or the method
            needs rays and the clouds are plain points.
    """
    return estimate(window_of_pair(source, target, interval), parameters)


def estimate(window: Window, parameters: Parameters) -> SceneFlow:
    """Estimate the scene flow of a window; a tracker starts with this window.

    Stages whose parameters did not change come from the window's cache: with another γ, δ or
    N_min the clustering and the ICP rounds are not computed again.

    Raises:
        CloudError: the method needs rays and the window holds plain points.
        MethodError: the method gave no flow of the source points.
    """
    method = find_method(parameters.method)
    if method.needs_rays and len(window.source.ranges) == 0:
        raise CloudError(
            f"Method {method.name} looks along the rays of sensors; give it clouds of a recording "
            "and not plain points."
        )
    if method.tracker is not None:
        return checked_flow(method, window, method.tracker(parameters).step(window))
    assert method.flow is not None  # checked by `register`
    return checked_flow(method, window, method.flow(window, parameters))


def checked_flow(method: Method, window: Window, flow: object) -> SceneFlow:
    """The flow that a method has returned.

    Raises:
        MethodError: it is no scene flow of the window's source points.
    """
    size = len(window.source.points)
    if not isinstance(flow, SceneFlow):
        raise MethodError(f"Method {method.name} must return a SceneFlow, got {type(flow)}.")
    shapes = (np.shape(flow.label), np.shape(flow.velocity), np.shape(flow.cluster))
    if shapes != ((size,), (size, 3), (size,)):
        raise MethodError(
            f"Method {method.name} must return label, velocity and cluster of {size} source "
            f"points, got the shapes {', '.join(map(str, shapes))}."
        )
    return flow
