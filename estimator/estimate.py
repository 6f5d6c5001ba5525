"""Estimate of the scene flow of a pair of clouds or of a window of frames."""

from numpy.typing import ArrayLike

from estimator.cloud import CloudError, HasPoints
from estimator.flow import SceneFlow
from estimator.method import find_method
from estimator.parameters import Parameters
from estimator.window import Window, window_of_pair


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
        CloudError: a cloud of the wrong shape, or an interval not above zero; or the method looks
            along rays, and these are plain points.
    """
    return estimate(window_of_pair(source, target, interval), parameters)


def estimate(window: Window, parameters: Parameters) -> SceneFlow:
    """Estimate the scene flow of a window; a tracker sees this window as its first.

    Earlier results of the window's stages that these parameters do not change are used again:
    with other γ, δ and N_min the clustering and all ICP rounds done so far stay.

    Raises:
        CloudError: the method looks along rays, and the window holds plain points.
    """
    asked = find_method(parameters.method)
    if asked.needs_rays and len(window.source.ranges) == 0:
        raise CloudError(
            f"Method {asked.name} looks along the rays of sensors; give it clouds of a recording "
            "and not plain points."
        )
    if asked.tracker is not None:
        return asked.tracker(parameters).step(window)
    assert asked.flow is not None  # `register` saw to it
    return asked.flow(window, parameters)
