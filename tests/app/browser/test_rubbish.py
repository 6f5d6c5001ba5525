import logging

import pytest

from app.browser.rubbish import RubbishLog


@pytest.fixture
def lines(caplog: pytest.LogCaptureFixture):
    caplog.set_level(logging.WARNING, "app.browser.rubbish")
    return lambda: [record.getMessage() for record in caplog.records]


def test_the_first_client_is_told_of_at_once_and_further_ones_once_a_minute(lines):
    now = [0.0]
    log = RubbishLog(lambda: now[0])
    log.note(1, "ValueError", ended=False)
    said = "One client sent 1 message that could not be understood (the last: ValueError)."
    assert lines() == [said]
    for _ in range(20):
        now[0] += 2.0
        log.note(100, "KeyError", ended=True)
    assert len(lines()) == 1
    now[0] = 60.0
    log.note(2, "TypeError", ended=False)
    assert lines()[1:] == [
        "21 clients sent 2,002 messages that could not be understood (the last: TypeError). "
        "Connections that were ended for that: 20."
    ]


def test_the_end_tells_the_rest_and_nothing_where_there_is_none(lines):
    log = RubbishLog(lambda: 0.0)
    log.close()
    assert lines() == []
    log.note(5, "A", ended=False)
    log.note(7, "B", ended=False)
    log.close()
    log.close()
    assert [line.split(" that")[0] for line in lines()] == [
        "One client sent 5 messages",
        "One client sent 7 messages",
    ]
