"""Ranges of numbers as text."""


def span(found: list[float], form: str) -> str:
    """Least and greatest value as text, or one number if both read the same."""
    low, high = format(min(found), form), format(max(found), form)
    return low if low == high else f"{low} to {high}"
