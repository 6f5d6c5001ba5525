"""Line in the corner of a drawing: recording, frame, time, interval, method and parameters."""

import math
from collections.abc import Mapping
from types import MappingProxyType

from app.analysis.pairs import Pair
from estimator import ParameterInfo, Parameters, find_method, values_of
from recordings import Recording
from robot_assets.printable import printable

SEPARATOR = " · "
_LONGEST_NAME = 60  # characters of a recording's name, whose middle is left out beyond


def corner_line(
    recording: Recording,
    frame: int,
    pair: Pair | None,
    parameters: Parameters,
    sides: Mapping[str, Parameters] = MappingProxyType({}),
) -> str:
    """The line as one text; arguments as in `corner_parts`."""
    return SEPARATOR.join(corner_parts(recording, frame, pair, parameters, sides))


def corner_parts(
    recording: Recording,
    frame: int,
    pair: Pair | None,
    parameters: Parameters,
    sides: Mapping[str, Parameters] = MappingProxyType({}),
) -> tuple[str, ...]:
    """Parts of the line, of which each makes sense alone: a narrow page may break between them.

    Args:
        recording: that is drawn.
        frame: k.
        pair: of the frame, None where it could not be drawn.
        parameters: of the estimate.
        sides: {A or B: its parameters} where the flow of both is drawn.
    """
    simulated = " (simulated)" if recording.simulated else ""
    seconds = float(recording.stamps[frame] - recording.stamps[0])
    parts = [
        f"{_shortened(printable(recording.name))}{simulated}",
        f"frame {frame} of {len(recording) - 1}",
        f"{seconds:.2f} s",
    ]
    if pair is not None and not math.isnan(pair.interval):
        parts.append(f"Δt {pair.interval:.3f} s")
    if not sides:
        return (*parts, parameters.method, parameters_text(parameters))
    for side, its_parameters in sides.items():
        parts.append(f"{side}: {its_parameters.method} {parameters_text(its_parameters)}")
    return tuple(parts)


def parameters_text(parameters: Parameters) -> str:
    """A method's parameters that have a slider, and all others that differ from their defaults."""
    values = values_of(parameters)
    infos = find_method(parameters.method).infos()
    return ", ".join(
        _entry(name, info, values[name])
        for name, info in infos.items()
        if info.slider or values[name] != info.default
    )


def _entry(name: str, info: ParameterInfo, value: object) -> str:
    plain = info.symbol or name.rpartition(".")[2].replace("_", " ")
    if isinstance(value, bool):
        return plain if value else f"no {plain}"
    if value is None:
        return f"{plain} unset"
    number = f"{value:g}" if isinstance(value, float) else str(value)
    # The names of counts say what they count.
    unit = f" {info.unit}" if info.unit and info.kind is float else ""
    return f"{plain} {number}{unit}"


def _shortened(name: str) -> str:
    if len(name) <= _LONGEST_NAME:
        return name
    half = _LONGEST_NAME // 2 - 1
    return f"{name[:half]}…{name[-half:]}"
