import numpy as np
import pytest

from recordings.simulation.imperfections import IMPERFECTIONS, Bias, Streams, in_order


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


def test_the_bias_of_a_sensor_is_a_line_over_the_distance_and_the_same_in_all_its_zones():
    bias = Bias(5_000, np.random.default_rng(1))
    at_0, at_1, at_2 = (bias.error(np.full((5_000, 8, 8), d)) for d in (0.0, 1.0, 2.0))
    assert at_2 - at_1 == pytest.approx(at_1 - at_0)
    assert np.ptp(at_1, axis=(1, 2)) == pytest.approx(np.zeros(5_000))
    assert at_0[:, 0, 0].std() == pytest.approx(0.010, rel=0.05)
    assert (at_1 - at_0)[:, 0, 0].std() == pytest.approx(0.01, rel=0.05)
