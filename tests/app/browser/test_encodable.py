import msgspec
from hypothesis import given
from hypothesis import strategies as st

from app.browser.encodable import encodable

TEXTS = st.text(st.characters(exclude_categories=()))
VALUES = st.recursive(
    st.none() | st.booleans() | st.integers() | st.floats() | TEXTS,
    lambda inner: st.lists(inner) | st.tuples(inner, inner) | st.dictionaries(TEXTS, inner),
)


def test_lone_surrogates_are_replaced_wherever_they_are():
    props = {"label": "a\udcff", "options": ("fine", "\ud800!")}
    sent = encodable({"props": props, "\ud800": ["\udfff"]})
    assert sent["props"] == {"label": "a\ufffd", "options": ("fine", "\ufffd!")}
    assert sent["\ufffd"] == ["\ufffd"]
    assert props["label"] == "a\udcff"  # others may look at it still


def test_what_can_be_encoded_stays_the_same_object():
    large = memoryview(b"\xff" * 100)
    for value in ({"a": (None, "ä\U0001f600", [1, (2.0, "x")]), "b": large}, 2**64 - 1, -(2**63)):
        assert encodable(value) is value


def test_whole_numbers_are_clipped_to_what_can_be_sent():
    assert encodable([10**400, -(10**400)]) == [2**64 - 1, -(2**63)]


@given(VALUES)
def test_everything_can_be_encoded(value):
    msgspec.msgpack.encode(encodable(value))
