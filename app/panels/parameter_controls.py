"""Controls of parameters, created from their descriptions."""

from typing import Any

import viser

from estimator import ParameterInfo, method_names

UNSET = 0
"""Number that stands for an unset parameter in its field."""

Control = viser.GuiInputHandle[Any]


def label_of(name: str, info: ParameterInfo) -> str:
    """Label of a parameter's control: its symbol, or its name without the method's prefix."""
    # Longer words would be broken in the label's column.
    plain = name.rpartition(".")[2].replace("_", " ").replace("correspondence", "corresp.")
    unit = f" [{info.unit}]" if len(info.unit) == 1 and not info.slider else ""
    unset = f" ({UNSET} = unset)" if info.optional else ""
    return (info.symbol or plain) + unit + unset


def range_of(info: ParameterInfo) -> tuple[float, float]:
    """(smallest, largest) number that a parameter's control takes."""
    if info.slider:
        return info.slider[0], info.slider[1]
    return (UNSET if info.optional else info.low), info.high


def rule_of(info: ParameterInfo, ends: tuple[float, float]) -> str:
    """What becomes of a number in a parameter's field, in a sentence.

    Args:
        info: description of the parameter.
        ends: (smallest, largest) number that its control takes.
    """
    low, high = ends
    unit = f" {info.unit}" if info.unit else ""
    whole = "Whole numbers from" if info.kind is int else "From"
    if info.optional:
        reach = f"{whole} {info.low:g} to {high:g}{unit}, or {UNSET} for unset"
    else:
        reach = f"{whole} {low:g} to {high:g}{unit}"
    return f"{reach}; one beyond becomes the nearest."


def shown_value(value: object) -> Any:  # noqa: ANN401 (of any parameter)
    """Convert a parameter's value to that of its control."""
    return UNSET if value is None else value


def entered_value(control: Control, info: ParameterInfo) -> Any:  # noqa: ANN401
    """Convert a control's value to that of its parameter."""
    return None if info.optional and control.value == UNSET else control.value


def add_control(gui: viser.GuiApi, name: str, info: ParameterInfo, value: Any) -> Any:  # noqa: ANN401
    """Add a slider where the parameter has one, else a dropdown, a checkbox or a number field."""
    label, hint = label_of(name, info), _hint(info)
    if info.slider is not None:
        return _add_slider(gui, label, hint, info, value)
    if name == "method":
        return gui.add_dropdown(label, method_names(), initial_value=value, hint=hint)
    if info.choices:
        return gui.add_dropdown(label, info.choices, initial_value=value, hint=hint)
    if info.kind is bool:
        return gui.add_checkbox(label, value, hint=hint)
    if info.kind is str:
        return gui.add_text(label, value, hint=hint)
    low, high = (info.kind(end) if abs(end) < float("inf") else None for end in range_of(info))
    return gui.add_number(
        label,
        initial_value=shown_value(value),
        min=low,
        max=high,
        step=0.01 if info.kind is float else 1,
        hint=hint,
    )


def _add_slider(
    gui: viser.GuiApi, label: str, hint: str, info: ParameterInfo, value: float
) -> viser.GuiSliderHandle[Any]:
    assert info.slider is not None
    low, high, step = (info.kind(end) for end in info.slider)
    # A longer unit would overlap the slider's number; the hint contains it. Without marks, viser
    # writes the ends that the slider has at the time.
    unit = f" {info.unit}" if info.kind is float and len(info.unit) == 1 else ""
    return gui.add_slider(
        label,
        # A flag may have set a value beyond the slider's range.
        min=min(low, value),
        max=max(high, value),
        step=step,
        initial_value=value,
        marks=((low, f"{low:g}"), (high, f"{high:g}{unit}")) if unit else None,
        hint=hint,
    )


def _hint(info: ParameterInfo) -> str:
    text = info.text[:1].upper() + info.text[1:]
    said = [text]
    if info.kind in (int, float):
        said.append(rule_of(info, range_of(info)).removesuffix("."))
    if info.kind is not bool:
        said.append(f"Default {'unset' if info.default is None else info.default}")
    return ". ".join(said) + "."
