"""How much a cache holds of what weighs."""

from hypothesis import given
from hypothesis import strategies as st

from app.analysis.cache import Cache


def weighing(heaviest: int, size: int = 100) -> Cache[str, str]:
    """A cache of texts, which weigh their lengths."""
    return Cache(size, len, heaviest)


def test_the_oldest_are_forgotten_until_the_rest_is_light_enough():
    cache = weighing(6)
    for text in ("aa", "bb", "cc"):
        cache.get(text, lambda text=text: text)
    cache.get("aa", lambda: "is there")
    assert cache.get("ddd", lambda: "ddd") == "ddd"
    assert [key for key, _ in cache.items()] == ["aa", "ddd"]


def test_one_alone_may_weigh_more():
    cache = weighing(3)
    cache.get("a", lambda: "a")
    assert cache.get("long", lambda: "long text") == "long text"
    assert cache.known("long") == "long text"
    assert len(cache) == 1
    cache.get("b", lambda: "b")
    assert [key for key, _ in cache.items()] == ["b"]


def test_what_was_forgotten_while_it_was_made_weighs_nothing():
    cache = weighing(3, size=1)

    def make() -> str:
        cache.get("b", lambda: "b")  # the cache has room for one
        return "aaaa"

    assert cache.get("a", make) == "aaaa"
    assert cache.get("c", lambda: "ccc") == "ccc"
    assert cache.known("c") == "ccc"


@given(st.lists(st.text("abc", max_size=4), max_size=40), st.integers(0, 12), st.integers(1, 6))
def test_it_is_never_heavier_unless_it_holds_one(asked: list[str], heaviest: int, size: int):
    cache = weighing(heaviest, size)
    for text in asked:
        assert cache.get(text, lambda text=text: text) == text
        held = [value for _, value in cache.items()]
        assert text in held
        assert len(held) <= size
        assert len(held) == 1 or sum(map(len, held)) <= heaviest
