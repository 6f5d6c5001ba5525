"""Captions of exported files: recording, frame, method and parameters."""

import json
from collections.abc import Mapping
from types import MappingProxyType

from app.output.text import escaped
from estimator import Parameters, to_nested
from recordings import Recording


def caption(
    recording: Recording,
    parameters: Parameters,
    frame: int | None,
    sides: Mapping[str, Parameters] = MappingProxyType({}),
) -> Mapping[str, str]:
    """Caption as {name: value}, in reading order.

    Args:
        recording: that is shown.
        parameters: of the estimate, written as JSON that --parameters takes.
        frame: k, None for a file with many.
        sides: {A or B: its parameters} where the flow of both is drawn.
    """
    entries = {"Recording": recording.name, "Data": origin(recording)}
    if frame is not None:
        seconds = float(recording.stamps[frame] - recording.stamps[0])
        entries["Frame"] = f"{frame} of {len(recording) - 1}, at {seconds:.3f} s"
    entries["Fixed frame"] = recording.fixed_frame
    entries["Method"] = parameters.method
    entries["Parameters"] = json.dumps(to_nested(parameters))
    for side, its_parameters in sides.items():
        entries[f"Parameters of {side}"] = json.dumps(to_nested(its_parameters))
    return {name: escaped(value) for name, value in entries.items()}


def origin(recording: Recording) -> str:
    """Origin of the data: measured, or simulated with scenario, speed and trial."""
    source = recording.provenance
    if not recording.simulated:
        return "measured"
    if source is None:
        return "simulated"
    return f"simulated: {source.experiment}"
