from dataclasses import replace

from app.session.history import ParameterHistory
from estimator import Parameters

START = Parameters()


def changed(history, parameters, now, **values):
    after = replace(parameters, **values)
    history.note(parameters, after, now)
    return after


def test_a_drag_is_one_change():
    history, parameters = ParameterHistory(), START
    for i in range(20):
        parameters = changed(history, parameters, 5.0 + 0.1 * i, delta=0.05 + 0.01 * i)
    assert history.undo(parameters) == START
    assert history.undo(START) is None
    assert history.redo(START) == parameters


def test_a_pause_or_another_parameter_begins_another_change():
    history = ParameterHistory()
    first = changed(history, START, 0.0, delta=0.1)
    second = changed(history, first, 5.0, delta=0.2)
    third = changed(history, second, 5.1, n=3)
    assert history.undo(third) == second
    assert history.undo(second) == first
    assert history.undo(first) == START


def test_a_change_ends_what_could_be_redone():
    history = ParameterHistory()
    first = changed(history, START, 0.0, delta=0.1)
    back = history.undo(first)
    assert back == START
    other = changed(history, back, 0.1, delta=0.3)
    assert history.redo(other) is None
    assert history.undo(other) == START


def test_going_back_undoes_what_changed_and_leaves_the_rest():
    history = ParameterHistory()
    changed(history, START, 0.0, delta=0.1)
    assert history.undo(Parameters(delta=0.1, n=3)) == Parameters(n=3)


def test_no_change_is_not_remembered():
    history = ParameterHistory()
    changed(history, START, 0.0, delta=START.delta)
    assert history.undo(START) is None


def test_what_is_no_drag_is_a_change_of_its_own():
    history = ParameterHistory()
    first = changed(history, START, 0.0, delta=0.1)
    copied = changed(history, first, None, delta=0.2)
    last = changed(history, copied, 0.2, delta=0.3)
    assert history.undo(last) == copied
    assert history.undo(copied) == first
    assert history.undo(first) == START
