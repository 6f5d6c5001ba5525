"""What the plots say in words."""

import numpy as np

from app.analysis.comparison import A, B
from app.analysis.estimates import Estimates
from app.analysis.evaluation import evaluate
from app.analysis.survey import Survey
from app.panels.plot_words import means, progress, summary
from app.panels.tables import PLOTTED
from estimator import METRIC_INFO, Parameters
from recordings import PairTruth
from tests.app.analysis.test_survey import filled
from tests.app.fake_recordings import FRAMES, fake_opened, fake_recording


def test_the_means_are_what_evaluate_says():
    opened, parameters = fake_opened(), Parameters()
    metrics = evaluate(opened.recording, parameters)
    assert metrics is not None
    said = means({A: filled(opened, parameters, Estimates())})
    for name in PLOTTED:
        assert said[name].startswith(f"Mean {METRIC_INFO[name].text(getattr(metrics, name))}, ")
    unknown = dict.fromkeys(PLOTTED, "Mean –")
    assert means({A: None}) == means({A: Survey(opened.recording, parameters)}) == unknown


def test_equal_numbers_of_pairs_are_said_once():
    opened, estimates = fake_opened(), Estimates()
    surveys = {
        A: filled(opened, Parameters(), estimates),
        B: filled(opened, Parameters(method="baseline"), estimates),
    }
    assert means(surveys)["precision"] == "Mean A 1.000, B 0.200; 32 of 32 pairs count"
    assert means({A: surveys[A], B: None})["precision"] == "Mean A 1.000; 32 of 32 pairs count"


def test_a_recording_none_of_whose_pairs_counts_says_so():
    fake = fake_recording()
    fake.truth = lambda _: np.zeros(3)
    said = summary({A: filled(fake_opened(fake), Parameters())}, has_truth=True)
    assert "No pair counts" in said
    assert "False flow: 0.0000." in said

    size = len(fake.cloud(0).points)
    fake.pair_truth = lambda *_: PairTruth(np.zeros((size, 3)), np.zeros((size, 3)))
    said = summary({A: filled(fake_opened(fake), Parameters())}, has_truth=True)
    assert "False flow: 0.2000." in said
    fake.pair_truth = lambda *_: PairTruth(np.zeros((size, 3)), None)
    assert "False" not in summary({A: filled(fake_opened(fake), Parameters())}, has_truth=True)


def test_while_it_is_filled_it_says_how_far_it_is():
    survey = Survey(fake_recording(), Parameters())
    assert f"8 of {FRAMES} frames" in summary({A: survey}, has_truth=True)
    assert progress({A: survey, B: None}) == (0.1, f"8 of {2 * FRAMES} frames")
    assert progress({A: None, B: None}) == (0.0, "")
