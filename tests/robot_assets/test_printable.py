import pytest

from robot_assets.printable import printable


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("a plain größe – 表 🤖", "a plain größe – 表 🤖"),
        ("\x1b[31mred\x07", r"\x1b[31mred\x07"),
        ("two\nlines\r\t", r"two\nlines\r\t"),
        ("\x9b2J", r"\x9b2J"),
        ("gpj\u202etxt", r"gpj\u202etxt"),
        ("\udcff.mcap", r"\udcff.mcap"),  # surrogate escape: a name that is not UTF-8
    ],
)
def test_what_a_terminal_would_obey_is_an_escape(text: str, said: str):
    assert printable(text) == said


def test_what_is_very_long_loses_its_middle():
    said = printable(f"The frame {'x' * 1_000_000} is left out.")
    assert said == f"The frame {'x' * 100}...{'x' * 100} is left out."
    assert len(printable("a " * 1_000_000)) < 300
    assert printable("y" * 500) == "y" * 500
