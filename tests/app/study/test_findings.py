from dataclasses import replace

from app.study.findings import findings
from recordings.simulation import SPEEDS
from tests.app.study.made import PLAN, good, made

WHY = "Frames 13 and 23, 80 of 81 moving points: Unassigned: no point is near enough."


def said(*rows, methods=("paper", "baseline"), sweep=()) -> str:
    return "\n".join(findings(replace(PLAN, methods=methods, sweep=sweep), list(rows)))


def y(angle: float, error: float, method: str = "paper"):
    return [made(speed=speed, method=method, metrics=good(angle, error)) for speed in SPEEDS]


def test_errors_are_judged_against_the_papers_mean_over_speeds():
    # The paper's means: 8.754 deg, 0.04475 m/s.
    assert "8.8 deg and 0.045 m/s, of which these are 1.03 and 1.12 times: within 1.5" in said(
        *y(9.0, 0.050)
    )
    assert "beyond 1.5 times" in said(*y(9.0, 0.068))
    assert "beyond 1.5 times" in said(*y(13.2, 0.045))
    assert "and clearly smaller" in said(*y(4.0, 0.040))
    assert "and clearly smaller" not in said(*y(9.0, 0.040))


def test_only_speeds_that_both_have_are_compared():
    rows = [made(metrics=good(10.313, 0.067)), made(speed=0.5, metrics=good(90.0, 1.0))]
    text = said(*rows)
    assert "the one speed: 10.3 deg and 0.067 m/s" in text
    assert "1.00 and 1.00 times" in text
    assert "y-axis: there are no recordings at 0.15, 0.20, 0.25 m/s here." in text
    assert "x-axis: there are no recordings of it here." in text


def test_the_baseline_fails_above_50_degrees():
    assert "It is above 50 deg, so it fails here" in said(*y(60.0, 0.2, "baseline"))
    assert "It is not above 50 deg" in said(*y(40.0, 0.2, "baseline"))


def test_detection_at_small_n_is_said():
    high = [made(n=8, trial=t, metrics=good(6.0, 0.03)) for t in (1, 2)]
    text = said(*high, made(n=1), methods=("paper",), sweep=(1, 8))
    assert "coverage over n: 1.00 at n = 8, 0.00 at n = 1" in text
    assert "0.020 to 0.020 m" in text
    text = said(*high, made(n=1, metrics=good(6.0, 0.03)), methods=("paper",), sweep=(1, 8))
    assert "detection does not fall for small n" in text


def test_what_could_not_be_computed_is_said_with_its_reason():
    rows = [made(n=10, why=WHY), made(n=8, metrics=good(6.0, 0.03))]
    text = said(*rows, methods=("paper",), sweep=(8, 10))
    assert "could not be computed at n = 10 and 0.30 m/s: 7 pairs count" in text
    assert "the object goes 0.20 m" in text
    assert "Unassigned: no point is near enough." in text
    assert "Here 0 of 1 trials give some flow" in text
    assert "The trials without any say: Unassigned: no point is near enough." in text

    text = said(made(n=10, metrics=good(6.0, 0.03)), made(n=10, trial=2), sweep=(10,))
    assert "1 of 2 trials give some flow; coverage at this speed is 0.50 at n = 10" in text

    short = said(made(n=10, metrics={"pairs": 0}), methods=("paper",), sweep=(10,))
    assert "does not move for 10 frames, and no pair counts" in short


def test_a_trial_that_decides_its_cell_is_named():
    rows = [made(trial=trial, metrics=good(6.0, 0.03)) for trial in (1, 2, 3)]
    assert "alone has" not in said(*rows)
    text = said(*rows, made(trial=4, metrics=good(29.0, 0.29)))
    assert "at 0.30 m/s: trial 4 alone has 29.0 deg and 0.290 m/s" in text
    assert "median of the trials is 6.0 deg and 0.030 m/s" in text
