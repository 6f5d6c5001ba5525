"""Numbers as people say them."""


def span(found: list[float], form: str) -> str:
    """From the least to the most, once where people read the same."""
    low, high = format(min(found), form), format(max(found), form)
    return low if low == high else f"{low} to {high}"
