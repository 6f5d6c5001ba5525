"""Images of the sensors as compact messages for the page."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from app.analysis.moving_targets import moving_targets
from app.analysis.pairs import Pair
from app.analysis.zones import SOURCE, ZoneState, cloud_of, frame_of, zone_states
from app.browser.assets import packed
from app.panels.answer_rows import read_at
from app.panels.sensor_names import captions, groups
from app.scene.colours import Colour, css
from app.scene.flow_colours import faded
from app.scene.palettes import Palette
from app.scene.theme import background
from app.session.inspection import BY_DISTANCE, ImageSettings
from estimator import Label
from recordings import Cloud, RecordedSensor, Recording

STATES, LABELS = 200, 210
"""Values of a zone: below `STATES` its place along the scale, from there on its state, and from
`LABELS` on its label. `zone_image.js` knows `STATES`, too."""

_MOST_ZONES = 6400  # of a message; larger recordings send every second, fourth ... zone
_MOST_TEXTS = 256  # zones of a sensor whose numbers are written into its enlarged image
_ROUND = (0.5, 1.0, 1.5, 2.0, 3.0, 4.0, 6.0, 8.0, 12.0)  # metres, ends of the scale
_LATE = 0.002  # seconds after the frame's stamp
_OTHER = 3
"""Label of a target point that belongs to nothing that moves."""


@dataclass(frozen=True)
class Look:
    """How images are shown.

    Attributes:
        images: which ones, and what their colours say.
        palette: of the drawing.
        dark: whether the page is dark.
        limit: distance at the end of the scale, metres.
    """

    images: ImageSettings
    palette: Palette
    dark: bool
    limit: float


def layout(recording: Recording) -> dict[str, Any]:
    """Names and grids of a recording's sensors, for `sensors.open`."""
    step, names = stride(recording.sensors), [sensor.name for sensor in recording.sensors]
    return {
        "names": names,
        "captions": captions(names),
        "groups": [{"name": name, "sensors": members} for name, members in groups(names)],
        "full": [list(sensor.grid) for sensor in recording.sensors],
        "grids": [[-(-side // step) for side in sensor.grid] for sensor in recording.sensors],
    }


def stride(sensors: Sequence[RecordedSensor]) -> int:
    """Every how many-th row and column of zones is sent."""
    zones, step = sum(rows * columns for rows, columns in (s.grid for s in sensors)), 1
    while zones / step**2 > _MOST_ZONES:
        step *= 2
    return step


def scale_limit(cloud: Cloud, before: float) -> float:
    """Distance at the end of the scale: a round number of metres, never below that of `before`."""
    measured = cloud.ranges[np.isfinite(cloud.ranges)]
    farthest = float(np.percentile(measured, 98)) if len(measured) else 0.0
    return max(before, next((end for end in _ROUND if end >= farthest), _ROUND[-1]))


def images(
    recording: Recording, pair: Pair, max_range: float, selected: int | None, look: Look
) -> dict[str, Any] | None:
    """Images of one frame, for `sensors.show`; None where the pair has no such cloud.

    Args:
        recording: of the pair.
        pair: of the frame.
        max_range: of the pair's clouds, metres.
        selected: sensor whose image is enlarged, None for none.
        look: of the images.
    """
    side = look.images.side
    cloud, frame = cloud_of(pair, side), frame_of(pair, side)
    if cloud is None:
        return None
    messages = recording.latest_messages(frame)
    states = zone_states(cloud, max_range, messages)
    moving, label = _labels(pair, cloud, look)
    zones = _Zones(cloud, states)
    values = zones.values(label, look)
    moves = zones.spread(moving, False)
    step = stride(recording.sensors)
    grids = [sensor.grid for sensor in recording.sensors]
    sent = [values[s, :r:step, :c:step].ravel() for s, (r, c) in enumerate(grids)]
    sent_moves = [moves[s, :r:step, :c:step].ravel() for s, (r, c) in enumerate(grids)]
    lateness = messages - cloud.stamp
    shown = f"Frame {frame} ({side})"
    every = "2nd" if step == 2 else f"{step}th"
    return {
        "title": shown if step == 1 else f"{shown}, every {every} row and column of zones",
        "values": packed(np.concatenate(sent), "u1"),
        "moves": packed(np.packbits(np.concatenate(sent_moves)), "u1"),
        "colours": packed(_colours(look), "u1"),
        "moving": css(look.palette.flow),
        "counts": np.bincount(cloud.sensor[moving], minlength=len(grids)).tolist(),
        "absent": np.flatnonzero(np.logical_not(lateness >= 0)).tolist(),
        "late": np.flatnonzero(lateness > _LATE).tolist(),
        "ticks": [f"{share * look.limit:g} m" for share in (0.0, 0.25, 1.0)],
        **_legend(look),
        "selected": None
        if selected is None
        else _enlarged(recording.sensors[selected], selected, lateness, values, moves, zones),
    }


class _Zones:
    """Zones of a cloud as arrays (S, R, C)."""

    def __init__(self, cloud: Cloud, states: NDArray[np.uint8]) -> None:
        self.cloud, self.states = cloud, states

    def spread(self, values: NDArray[Any], other: object) -> NDArray[Any]:
        """Values (N,) of the cloud's points in their zones, `other` in those without a point."""
        cloud, columns = self.cloud, self.cloud.ranges.shape[2]
        spread = np.full(cloud.ranges.shape, other, dtype=values.dtype)
        spread[cloud.sensor, cloud.zone // columns, cloud.zone % columns] = values
        return spread

    def values(self, label: NDArray[np.uint8], look: Look) -> NDArray[np.uint8]:
        """Value (S, R, C) of each zone, see `STATES`."""
        if look.images.colours == BY_DISTANCE:
            # By its root, so that what is near, as dirt on a sensor is, stands out.
            part = np.sqrt(np.nan_to_num(self.cloud.ranges / look.limit).clip(min=0))
            values = np.clip(part * STATES, 0, STATES - 1).astype(np.uint8)
        else:
            values = (LABELS + self.spread(label, 0)).astype(np.uint8)
        without = self.states != ZoneState.POINT
        values[without] = STATES + self.states[without]
        return values

    def texts(self, sensor: int, grid: tuple[int, int]) -> list[str]:
        """Number of each zone of a sensor: metres, or the status that refuses it."""
        cloud, texts = self.cloud, list[str]()
        for at in ((sensor, *place) for place in np.ndindex(*grid)):
            if np.isfinite(cloud.ranges[at]):
                texts.append(f"{cloud.ranges[at]:.2f}")
            elif cloud.status is not None and self.states[at] == ZoneState.REFUSED:
                texts.append(f"s{cloud.status[at]}")
            else:
                texts.append("")
        return texts


def _labels(pair: Pair, cloud: Cloud, look: Look) -> tuple[NDArray[np.bool_], NDArray[np.uint8]]:
    """Whether each point (N,) of a cloud moves, and its label."""
    if look.images.side == SOURCE:
        if pair.flow is None:
            nothing = np.zeros(len(cloud.points), dtype=bool)
            return nothing, np.full(len(nothing), Label.MOVING, dtype=np.uint8)
        return pair.flow.moving, pair.flow.label.astype(np.uint8)
    moving = moving_targets(pair)
    return moving, np.where(moving, Label.MOVING, _OTHER).astype(np.uint8)


def _colours(look: Look) -> NDArray[np.uint8]:
    """Colours (256, 4) of all values, transparent where a zone has none."""
    colours = np.zeros((256, 4), dtype=np.uint8)
    # Near is bright: what is near matters most.
    colours[:STATES, :3] = look.palette.along_ramp(np.linspace(1.0, 0.0, STATES))
    colours[:STATES, 3] = 255
    for label, colour in _of_labels(look).items():
        colours[LABELS + label] = (*colour, 255)
    return colours


def _of_labels(look: Look) -> dict[int, Colour]:
    palette = look.palette
    if look.images.side == SOURCE:
        return {
            Label.UNASSIGNED: palette.unassigned,
            Label.STATIONARY: palette.stationary,
            Label.MOVING: palette.source,
        }
    r, g, b = faded(np.array([palette.target], dtype=np.uint8), background(look.dark))[0].tolist()
    return {Label.MOVING: palette.target, _OTHER: (r, g, b)}


def _legend(look: Look) -> dict[str, Any]:
    """Meaning of colours and signs."""
    signs = [
        ("×", "refused by status"),
        ("•", "beyond max range"),
        ("╱", "the robot"),
        ("▫", "sensor not placed"),
        ("", "empty: no target"),
        ("▨", "no message"),
        ("◤", "read late"),
    ]
    ramp: list[str] | None = None
    if look.images.colours == BY_DISTANCE:
        ramp = [css(colour) for colour in reversed(look.palette.ramp)]
        note = "Colour is distance along the optical axis, not a cloud's colour. "
    else:
        words = {Label.UNASSIGNED: "unassigned", Label.STATIONARY: "stationary"}
        words |= {Label.MOVING: "moving", _OTHER: "other"}
        named = [(css(colour), words[label]) for label, colour in _of_labels(look).items()]
        signs = [*named, *signs]
        note = "Colours as in the scene. "
    note += "As the sensor looks out: row 0 on top, column 0 on the left. Outlined: moving."
    return {"ramp": ramp, "legend": signs, "note": note}


def _enlarged(
    sensor: RecordedSensor,
    index: int,
    lateness: NDArray[np.float64],
    values: NDArray[np.uint8],
    moves: NDArray[np.bool_],
    zones: _Zones,
) -> dict[str, Any]:
    rows, columns = sensor.grid
    return {
        "sensor": index,
        "title": f"{sensor.name}, read {read_at(float(lateness[index]))}",
        "rows": rows,
        "columns": columns,
        "values": packed(values[index, :rows, :columns], "u1"),
        "moves": packed(np.packbits(moves[index, :rows, :columns].ravel()), "u1"),
        "texts": zones.texts(index, sensor.grid) if rows * columns <= _MOST_TEXTS else None,
    }
