from dataclasses import replace

from app.study.ablation_findings import ablation_findings
from app.study.further_tables import ablation_table
from tests.app.study.made import PLAN, good, made


def test_the_largest_change_and_what_exact_readings_leave_are_said():
    plan = replace(PLAN, ablation=True, methods=("paper",))
    rows = [
        made(speed=0.15, noise="paper", metrics=good(8.0, 0.04)),
        made(speed=0.15, noise="none", metrics=good(6.0, 0.03)),
        made(speed=0.15, imperfections=("bias",), metrics=good(11.0, 0.06)),
    ]
    table = ablation_table(plan, rows)
    assert table is not None
    most, exact = ablation_findings(plan, table)
    assert "8.0 deg and 0.040 m/s with noise model paper" in most
    assert "the imperfection bias changes that most, to 11.0 deg and 0.060 m/s" in most
    assert "exact readings leave 6.0 deg and 0.030 m/s, 75 % of the angle deviation" in exact

    none = ablation_table(plan, [made(speed=0.15)])
    assert none is not None
    assert ablation_findings(plan, none) == []
