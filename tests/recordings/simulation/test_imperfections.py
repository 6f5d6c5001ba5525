import pytest

from recordings.simulation.imperfections import IMPERFECTIONS, Streams, in_order


def test_imperfections_have_a_name_and_a_text_of_one_line():
    for name, imperfection in IMPERFECTIONS.items():
        assert imperfection.name == name
        assert imperfection.text
        assert "\n" not in imperfection.text


def test_names_are_put_in_order_and_unknown_ones_are_refused():
    assert in_order(reversed(IMPERFECTIONS)) == tuple(IMPERFECTIONS)
    assert in_order(["bias", "bias"]) == ("bias",)
    with pytest.raises(ValueError, match="no imperfection rust; there are bias"):
        in_order(["bias", "rust"])


def test_streams_depend_on_the_key_and_on_the_name_alone():
    def first(key: list[int], name: str) -> float:
        return float(Streams(key).of(name).random())

    assert first([1, 2], "bias") == first([1, 2], "bias")
    others = [first([1, 2], "ramps"), first([1, 3], "bias"), first([1, 2, ord("b")], "ias")]
    assert first([1, 2], "bias") not in others
