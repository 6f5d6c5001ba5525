import pytest

from app.analysis.json_text import LARGEST, from_json, kind_of
from app.errors import InputError


def test_content_is_that_of_json():
    text = '{"a": [1, -2.5, true, null, "x"], "b": {"a": 1e3}}'
    assert from_json(text, "x.json") == {"a": [1, -2.5, True, None, "x"], "b": {"a": 1000.0}}


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("{", "x.json is not JSON: Expecting property name enclosed in double quotes: line 1 "),
        ('{"n": 3, "n": 4}', "x.json has the key 'n' twice; leave one out."),
        ('[{"a": {"\\n": 3, "\\n": 3}}]', r"x.json has the key '\n' twice; leave one out."),
        ('{"gamma": NaN}', "x.json holds NaN, which is not a JSON number; give a number."),
        ("[-Infinity]", "x.json holds -Infinity, which is not a JSON number; give a number."),
        (f"[{5000 * '1'}]", "x.json holds a number of 5000 digits; give a smaller one."),
        (100_000 * "[", "x.json has too deeply nested lists or tables."),
        (100_000 * '{"n":', "x.json has too deeply nested lists or tables."),
        ((LARGEST + 1) * " ", "x.json has more than 10 MB, too much to be read as JSON;"),
    ],
    ids=["cut", "twice", "deep twice", "nan", "infinity", "digits", "lists", "tables", "size"],
)
def test_what_is_wrong_is_one_sentence(text: str, said: str):
    with pytest.raises(InputError) as caught:
        from_json(text, "x.json")
    assert str(caught.value).startswith(said)
    assert str(caught.value).isprintable()


def test_kinds_are_said_in_words():
    assert [kind_of(value) for value in ({}, [], "", True, 1, 1.5, None)] == [
        "a table",
        "a list",
        "a text",
        "true or false",
        "a number",
        "a number",
        "null",
    ]
