"""Names of sensors, and what makes two of them the same."""

from collections.abc import Iterable


def plain_name(text: str) -> str:
    """A name, topic or frame by which sensors are matched: small letters, digits, underscores."""
    return "_".join("".join(c if c.isalnum() else " " for c in text.lower()).split())


def name_conflict(names: Iterable[str]) -> str | None:
    """Sentence on the first sensor whose name cannot be told from another's, None without one.

    Sensors are told apart in topics and frames, where only letters and digits count.
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
