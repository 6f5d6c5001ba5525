"""Ranges of numbers as text."""


def span(values: list[float], form: str) -> str:
    """Minimum and maximum as text, or one number if both are formatted alike."""
    low, high = format(min(values), form), format(max(values), form)
    return low if low == high else f"{low} to {high}"
