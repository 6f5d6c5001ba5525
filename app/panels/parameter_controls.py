"""Controls of parameters, made from their description."""

from typing import Any

import viser

from estimator import ParameterInfo, method_names

UNSET = 0
"""Number in the field of a parameter that is unset."""

Control = viser.GuiInputHandle[Any]


def label_of(name: str, info: ParameterInfo) -> str:
    """Label of a parameter's control: its symbol, or its name without its method's."""
    # A label's column breaks longer words anywhere.
    plain = name.rpartition(".")[2].replace("_", " ").replace("correspondence", "corresp.")
    return info.symbol or plain


def shown_value(value: object) -> Any:  # noqa: ANN401 (of any parameter)
    """A parameter's value as its control holds it."""
    return UNSET if value is None else value


def entered_value(control: Control, info: ParameterInfo) -> Any:  # noqa: ANN401
    """The parameter's value that a control holds."""
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
    # Without limits of its own, which would change what a person types without a word: what is out
    # of range is refused in words.
    return gui.add_number(
        label,
        initial_value=shown_value(value),
        step=0.01 if info.kind is float else 1,
        hint=hint + (f" ({UNSET}: unset)" if info.optional else ""),
    )


def _add_slider(
    gui: viser.GuiApi, label: str, hint: str, info: ParameterInfo, value: float
) -> viser.GuiSliderHandle[Any]:
    assert info.slider is not None
    low, high, step = (info.kind(end) for end in info.slider)
    # A longer unit would run into the number beside the slider; the hint says it.
    unit = f" {info.unit}" if info.kind is float and len(info.unit) == 1 else ""
    return gui.add_slider(
        label,
        # A flag may have asked for more than the slider offers.
        min=min(low, value),
        max=max(high, value),
        step=step,
        initial_value=value,
        marks=((low, f"{low:g}"), (high, f"{high:g}{unit}")),
        hint=hint,
    )


def _hint(info: ParameterInfo) -> str:
    said = f"{info.text} [{info.unit}]" if info.unit else info.text
    known = info.default is not None and info.kind is not bool
    return f"{said}; default {info.default}" if known else said
