"""Names of sensors, and conflicts between them."""

from collections.abc import Iterable


def plain_name(text: str) -> str:
    """Normalise a name, topic or frame for matching: lower case, digits, single underscores."""
    return "_".join("".join(c if c.isalnum() else " " for c in text.lower()).split())


def name_conflict(names: Iterable[str]) -> str | None:
    """Message about the first name that is empty or equal to another; None where all are distinct.

    Names appear in topics and frames, where only letters and digits are significant.
    """
    seen: dict[str, str] = {}
    for name in names:
        plain = plain_name(name)
        if not plain:
            return f"the name {name!r} of a sensor must have a letter or a digit"
        if seen.get(plain) == name:
            return f"two sensors have the name {name!r}; names must be unique"
        if plain in seen:
            return (
                f"the names {seen[plain]!r} and {name!r} must differ in letters or digits, by "
                "which sensors are told apart"
            )
        seen[plain] = name
    return None
