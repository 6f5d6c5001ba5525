"""Messages that are left out, told together by topic and reason."""

from recordings.left_out import LeftOut


def test_reasons_that_differ_in_numbers_are_one():
    left_out = LeftOut()
    for number in range(100):
        left_out.add("/eye", number, f"it has {number + 7} bytes, too few")
    left_out.add("/eye", 3, "it is turned round")
    assert left_out.sentences() == [
        "100 messages of /eye are left out, first 0: it has 7 bytes, too few.",
        "Message 3 of /eye is left out: it is turned round.",
    ]


def test_however_many_reasons_a_topic_has_few_are_told():
    left_out = LeftOut()
    for number in range(100):
        left_out.add("/eye", number, f"its encoding is {'x' * number}")
    left_out.add("/other", 0, "it is empty")
    said = left_out.sentences()
    assert len(said) == 7
    assert said[5] == "95 messages of /eye are left out, first 5: there are further reasons."
