"""Two methods of a user's own, in a file beside the project: `--method tests/own_methods.py:NAME`.

Neither is meant to be good. The first looks along the rays of all frames of its window; the second
is a tracker, whose flow depends on the frames before.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from estimator import (
    CheckedParameters,
    ClusterResult,
    Label,
    Method,
    Parameters,
    SceneFlow,
    StoryRow,
    Window,
    parameter,
)


@dataclass(frozen=True)
class RangeRateParameters(CheckedParameters):
    """Parameters of `RANGE_RATE`."""

    slowest: float = parameter(
        0.05,
        text="a zone whose range changes more slowly than this rests",
        symbol="v_0",
        unit="m/s",
        low=0.0,
        high=10.0,
        slider=(0.0, 0.5, 0.01),
    )
    robust: bool = parameter(True, text="take the median of the rates and not their mean")


def range_rate(window: Window, parameters: Parameters) -> SceneFlow:
    """Move each source point along its ray, as fast as the range of its zone changes.

    The rate is the median over all steps of the window, which resting sensors make a speed.
    """
    own = parameters.of(RangeRateParameters)
    ranges = np.array([frame.ranges for frame in window.frames])  # (F, S, R, C)
    with np.errstate(invalid="ignore"):
        rates = np.diff(ranges, axis=0) / np.diff(window.stamps)[:, None, None, None]
        seen = np.isfinite(rates).all(axis=0)
        middle = np.median if own.robust else np.mean
        rate = np.where(seen, middle(np.where(seen, rates, 0.0), axis=0), np.nan)
    source = window.source
    S, R, C = rate.shape
    rays = source.directions / source.directions[..., 2:]
    R_fixed_sensor = source.T_fixed_sensor[:, :3, :3]
    velocity = rate[..., None] * np.einsum("sij,srcj->srci", R_fixed_sensor, rays)
    of_points = velocity.reshape(S, R * C, 3)[source.sensor, source.zone]
    speed = np.abs(rate.reshape(S, R * C)[source.sensor, source.zone])
    with np.errstate(invalid="ignore"):
        moving = speed > own.slowest
    return _flow(moving, of_points, float(np.nanmax(speed, initial=0.0)), own.slowest)


def _flow(
    moving: NDArray[np.bool_], velocity: NDArray[np.float64], fastest: float, slowest: float
) -> SceneFlow:
    points = np.flatnonzero(moving)
    velocity = np.where(moving[:, None], velocity, np.nan)
    story = (
        StoryRow("fastest range rate", fastest, "m/s", threshold=slowest),
        StoryRow("seen along rays", "yes"),
    )
    cluster = ClusterResult(
        index=0,
        source=points,
        target=np.zeros(0, dtype=np.intp),
        remaining=points,
        rounds=(),
        label=Label.MOVING,
        velocity=velocity[points],
        reason="Moving: its ranges change.",
        story=story,
    )
    return SceneFlow(
        label=np.where(moving, Label.MOVING, Label.STATIONARY).astype(np.int64),
        velocity=velocity,
        cluster=np.where(moving, 0, -1).astype(np.int64),
        clusters=(cluster,) if len(points) else (),
    )


@dataclass(frozen=True)
class CentroidParameters(CheckedParameters):
    """Parameters of `CENTROID`."""

    memory: int = parameter(
        5, text="steps over which the velocity is averaged", unit="steps", low=1, high=100
    )


class CentroidTracker:
    """Tracker of the cloud's centroid: all points move as it did, on average over some steps."""

    def __init__(self, parameters: Parameters) -> None:
        self._memory = parameters.of(CentroidParameters).memory
        self._velocities: list[NDArray[np.float64]] = []

    def step(self, window: Window) -> SceneFlow:
        """Take the next window in."""
        source, target = window.source.points, window.target.points
        if len(source) and len(target):
            way = target.mean(axis=0) - source.mean(axis=0)
            self._velocities = [*self._velocities, way / window.interval][-self._memory :]
        known = self._velocities or [np.full(3, np.nan)]
        velocity = np.tile(np.mean(known, axis=0), (len(source), 1))
        moving = np.isfinite(velocity).all(axis=1)
        return SceneFlow(
            label=np.where(moving, Label.MOVING, Label.UNASSIGNED).astype(np.int64),
            velocity=velocity,
            cluster=np.full(len(source), -1, dtype=np.int64),
            clusters=(),
        )


RANGE_RATE = Method("range-rate", range_rate, parameters=RangeRateParameters, needs_rays=True)
CENTROID = Method("centroid", tracker=CentroidTracker, parameters=CentroidParameters, warm_up=5)
