import pytest

from robot_assets import plain_name
from robot_assets.rig_names import name_conflict


@pytest.mark.parametrize(
    ("text", "plain"),
    [
        ("Elbow/3", "elbow_3"),
        ("/tof//left arm-1/", "tof_left_arm_1"),
        ("größer", "größer"),
        ("/", ""),
    ],
)
def test_letters_and_digits_are_what_counts(text: str, plain: str):
    assert plain_name(text) == plain


@pytest.mark.parametrize(
    ("names", "said"),
    [
        (["a/0", "a/1", "b"], None),
        (["a", "b", "a"], "two sensors have the name 'a'; names must be unique"),
        (["a/0", "A 0"], "the names 'a/0' and 'A 0' must differ in letters or digits"),
        (["a", "--"], "the name '--' of a sensor must have a letter or a digit"),
    ],
)
def test_the_first_name_that_is_not_unique_is_said(names: list[str], said: str | None):
    found = name_conflict(names)
    assert found is None if said is None else str(found).startswith(said)
