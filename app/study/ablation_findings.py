"""Findings of the ablation, as sentences."""

from app.study.paper import method_label
from app.study.plan import Plan
from app.study.rows import Value
from app.study.table import Table


def ablation_findings(plan: Plan, table: Table) -> list[str]:
    """Sentences per method: the largest effect on its errors, and the errors with exact readings.

    Args:
        plan: of the study.
        table: of the ablation.
    """
    return [sentence for method in plan.methods for sentence in _of_method(plan, table, method)]


def _of_method(plan: Plan, table: Table, method: str) -> list[str]:
    lines = {
        (row["noise"], row["imperfection"]): row
        for row in table.rows
        if row["method"] == method and row["angle_deg"] is not None
    }
    usual = lines.pop((plan.noise, "none"), None)
    if usual is None or not lines:
        return []
    label = method_label(method)
    (noise, imperfection), most = max(
        lines.items(), key=lambda item: abs(_number(item[1]) - _number(usual))
    )
    switched = f"noise model {noise}" if imperfection == "none" else f"imperfection {imperfection}"
    sentences = [
        f"{label}: {_errors(usual)} with noise model {plan.noise}; the {switched} changes that "
        f"most, to {_errors(most)}."
    ]
    if exact := lines.get(("none", "none")):
        sentences.append(
            f"{label}: exact readings leave {_errors(exact)}, "
            f"{100 * _number(exact) / _number(usual):.0f} % of the angle deviation. That share "
            "comes from the few rays, which sample a surface anew wherever it goes, and from the "
            "method, and a sensor with less noise does not take it away."
        )
    return sentences


def _errors(row: dict[str, Value]) -> str:
    return f"{row['angle_deg']:.1f} deg and {row['velocity_error']:.3f} m/s"


def _number(row: dict[str, Value]) -> float:
    value = row["angle_deg"]
    assert isinstance(value, float)
    return value
