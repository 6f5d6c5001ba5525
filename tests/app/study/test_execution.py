from app.study.execution import outcomes
from app.study.rows import rows_of
from app.study.work import Ask, Simulated, Work
from estimator import Parameters


def test_two_cores_give_what_one_gives():
    parameters = (Parameters(), Parameters(method="baseline"))
    works = [
        Work(Simulated("towards", 0.3, trial), tuple(map(Ask, parameters))) for trial in (1, 2)
    ]

    def rows(jobs: int):
        return sorted(rows_of(outcomes(works, jobs)), key=lambda row: (row.trial, row.parameters.n))

    one = rows(1)
    assert len(one) == 4
    assert all(row.metrics["points_with_flow"] for row in one)
    assert rows(2) == one
