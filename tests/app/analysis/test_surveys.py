import os
import threading
import time
from dataclasses import replace

import numpy as np
import pytest

import app.analysis.pair_estimator
from app.analysis.estimates import Estimates
from app.analysis.survey import Survey
from app.analysis.surveys import Surveys
from estimator import Parameters, use_engine
from estimator.engines import COMPILED, REFERENCE
from recordings import RecordingError
from tests.app.fake_recordings import FRAMES, fake_opened, fake_recording
from tests.app.waiting import until
from tests.estimator.engines import using

CORES = os.cpu_count() or 1


class Listener:
    """Keeps what it is told."""

    def __init__(self):
        self.told = []

    def __call__(self, survey):
        self.told.append((int(survey.done.sum()), survey))

    @property
    def complete(self):
        return bool(self.told) and self.told[-1][1].complete


@pytest.fixture
def runs(monkeypatch):
    """The parameters of every run of the estimator."""
    found = []
    real = app.analysis.pair_estimator.estimate

    def run(pair, parameters):
        found.append(parameters)
        return real(pair, parameters)

    monkeypatch.setattr(app.analysis.pair_estimator, "estimate", run)
    return found


def test_a_survey_is_filled_and_told(runs):
    surveys, listener = Surveys(Estimates()), Listener()
    surveys.request("me", fake_opened(), Parameters(), listener)
    until(lambda: listener.complete)
    assert (listener.told[-1][1].moving[8:] == 100).all()
    assert len(runs) == FRAMES - 8
    until(lambda: surveys.idle)  # no thread without requests


def test_what_was_computed_is_not_computed_again(runs):
    estimates, opened = Estimates(), fake_opened()
    estimates.estimated(opened, 20, Parameters())
    surveys, listener = Surveys(estimates), Listener()
    surveys.request("me", opened, Parameters(), listener)
    until(lambda: listener.complete)
    assert len(runs) == FRAMES - 8
    estimates.estimated(opened, 30, Parameters())  # scrubbing
    again = Listener()
    assert surveys.request("you", opened, Parameters(), again) is listener.told[-1][1]
    assert again.told == []  # there is nothing to wait for
    assert len(runs) == FRAMES - 8


@pytest.mark.parametrize("change", [{"gamma": 0.3}, {"delta": 0.1}, {"n_min": 20}])
def test_other_thresholds_are_answered_from_the_rounds_at_once(runs, change):
    surveys, opened = Surveys(Estimates()), fake_opened()
    surveys.request("me", opened, Parameters(), lambda _: None)
    until(lambda: surveys.idle)
    survey = surveys.request("me", opened, replace(Parameters(), **change), lambda _: None)
    assert survey.complete
    assert len(runs) == FRAMES - 8
    expected = 0 if change == {"delta": 0.1} else 100
    assert (survey.moving[8:] == expected).all()


def test_rounds_of_what_was_played_are_kept_too(runs):
    estimates, opened = Estimates(), fake_opened()
    for k in range(8, FRAMES):
        estimates.estimated(opened, k, Parameters())
    surveys = Surveys(estimates)
    assert surveys.request("me", opened, Parameters(), lambda _: None).complete
    until(lambda: surveys.idle)
    assert surveys.request("me", opened, Parameters(gamma=0.3), lambda _: None).complete
    assert surveys.idle
    assert len(runs) == FRAMES - 8


def test_a_survey_of_one_engine_is_not_filled_by_another():
    estimates = Estimates()
    surveys, opened = Surveys(estimates), fake_opened()
    with using(REFERENCE):
        with estimates.foreground:
            survey = surveys.request("me", opened, Parameters(), lambda _: None)
        use_engine(COMPILED)
        until(lambda: surveys.idle)
    assert not survey.done[20:].all()
    assert not surveys.request("me", opened, Parameters(), lambda _: None).done[20:].any()
    surveys.cancel("me")
    until(lambda: surveys.idle)  # its last pairs are no other test's


def test_another_method_or_n_is_estimated(runs):
    surveys, opened = Surveys(Estimates()), fake_opened()
    surveys.request("me", opened, Parameters(), lambda _: None)
    until(lambda: surveys.idle)
    for change in ({"method": "baseline"}, {"n": 7}):
        assert not surveys.request(
            "me", opened, replace(Parameters(), **change), lambda _: None
        ).done[20]
        until(lambda: surveys.idle)
    assert len(runs) == FRAMES - 8 + FRAMES - 8 + FRAMES - 7


def test_what_is_known_of_a_long_recording_is_filled_in_by_the_background(monkeypatch):
    monkeypatch.setattr("app.analysis.surveys._SHORT", 10)
    surveys, opened, listener = Surveys(Estimates()), fake_opened(), Listener()
    surveys.request("me", opened, Parameters(), lambda _: None)
    until(lambda: surveys.idle)
    assert not surveys.request("me", opened, Parameters(delta=0.1), listener).done[20]
    until(lambda: listener.complete)
    assert len(listener.told) == 1


def test_the_frame_that_is_looked_at_and_its_neighbours_come_first():
    estimates, asked = Estimates(), []
    real = estimates.estimated_in_background

    def estimate(opened, k, parameters):
        asked.append(k)
        return real(opened, k, parameters)

    estimates.estimated_in_background = estimate
    surveys = Surveys(estimates)
    surveys.request("me", fake_opened(), Parameters(), lambda _: None, near=25)
    until(lambda: surveys.idle)
    assert sorted(asked[:17]) == list(range(17, 34))


def test_the_next_question_takes_the_place_of_the_last(runs):
    estimates = Estimates()
    surveys, first, second = Surveys(estimates), Listener(), Listener()
    opened = fake_opened()
    surveys.request("me", opened, Parameters(), first)
    until(lambda: first.told)
    surveys.request("me", opened, Parameters(delta=0.05), second)
    count = len(first.told)
    until(lambda: second.complete)
    assert len(first.told) <= count + 1  # one may have been on its way
    assert not first.complete
    assert runs.count(Parameters()) < FRAMES - 8


def test_a_cancelled_request_gets_no_more_notifications():
    surveys, listener = Surveys(Estimates()), Listener()
    surveys.request("me", fake_opened(), Parameters(), listener)
    until(lambda: listener.told)
    surveys.cancel("me")
    until(lambda: surveys.idle)
    assert not listener.complete


def test_two_who_ask_share_the_work(runs):
    surveys, opened = Surveys(Estimates()), fake_opened()
    listeners = [Listener(), Listener()]
    for number, listener in enumerate(listeners):
        surveys.request(number, opened, Parameters(), listener)
    until(lambda: all(listener.complete for listener in listeners))
    assert len(runs) == FRAMES - 8


def test_it_pauses_while_foreground_work_runs():
    estimates, listener = Estimates(), Listener()
    surveys = Surveys(estimates)
    with estimates.foreground:
        surveys.request("me", fake_opened(), Parameters(), listener)
        time.sleep(0.3)
        assert listener.told == []
    until(lambda: listener.complete)


def test_where_it_is_never_quiet_every_survey_goes_on_and_none_before_the_others(monkeypatch):
    monkeypatch.setattr("app.analysis.surveys._PATIENCE", 0.2)
    monkeypatch.setattr("app.analysis.estimates._PATIENCE", 0.02)
    estimates, ended = Estimates(), threading.Event()
    surveys = Surveys(estimates)

    def play():
        while not ended.is_set():
            with estimates.foreground:
                time.sleep(0.05)

    player = threading.Thread(target=play, daemon=True)
    player.start()
    found: list[Survey] = []
    for who, n in enumerate((5, 6)):
        surveys.request(who, fake_opened(), Parameters(n=n), found.append)
    try:
        until(lambda: len({id(survey) for survey in found}) == 2)
        first, second = {survey.parameters.n: survey for survey in found}.values()
        until(lambda: first.done.sum() > 12)
        assert abs(int(first.done.sum()) - int(second.done.sum())) <= 2 * CORES
    finally:
        ended.set()
        player.join()
        for who in range(2):
            surveys.cancel(who)


def test_what_is_played_fills_the_survey_without_being_computed_again(monkeypatch, runs):
    monkeypatch.setattr("app.analysis.surveys._PATIENCE", 0.2)
    estimates, opened, listener = Estimates(), fake_opened(), Listener()
    played = range(20, 32)
    for k in played:
        estimates.estimated(opened, k, Parameters())
    surveys = Surveys(estimates)
    with estimates.foreground:  # never quiet
        surveys.request("me", opened, Parameters(), listener)
        until(lambda: listener.told)
        assert listener.told[0][1].done[list(played)].all()
        assert len(runs) <= len(played) + 2
        assert not listener.complete
        surveys.cancel("me")


def test_a_broken_frame_is_a_gap():
    fake = fake_recording()
    whole = fake.cloud

    def cloud(k, max_range=4.0):
        if k == 25:
            raise RecordingError("it is broken at frame 25.")
        return whole(k, max_range)

    fake.cloud = cloud
    surveys, listener = Surveys(Estimates()), Listener()
    surveys.request("me", fake_opened(fake), Parameters(), listener)
    until(lambda: listener.complete)
    gaps = np.flatnonzero(np.isnan(listener.told[-1][1].moving))
    assert gaps.tolist() == [*range(8), 25, 33]
    until(lambda: surveys.idle)
    assert surveys.request("me", fake_opened(fake), Parameters(), listener).complete
    assert surveys.idle  # the broken ones are not tried again


def test_a_recording_that_was_closed_leaves_no_gap_behind():
    estimates, listener = Estimates(), Listener()
    surveys, fake = Surveys(estimates), fake_recording()
    surveys.request("me", fake_opened(fake), Parameters(), listener)
    until(lambda: listener.told)
    surveys.cancel("me")

    def closed(*_):
        raise ValueError("read of a closed file")

    fake.cloud = closed
    until(lambda: surveys.idle)
    again = Listener()
    surveys.request("me", fake_opened(), Parameters(), again)
    until(lambda: again.complete)
    assert (again.told[-1][1].moving[8:] == 100).all()


def test_surveys_of_long_recordings_are_fewer(monkeypatch):
    monkeypatch.setattr("app.analysis.surveys._MOST_FRAMES", 2 * FRAMES)
    surveys, opened = Surveys(Estimates()), fake_opened()
    for n in (5, 6, 7):
        surveys.request("me", opened, Parameters(n=n), lambda _: None)
    surveys.cancel("me")
    known = [n for n in (5, 6, 7) if surveys.known(opened, Parameters(n=n)) is not None]
    assert known == [6, 7]
