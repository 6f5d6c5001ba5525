"""Values that can be sent to a page: one that cannot be encoded would end its connection."""

from typing import Any

_LOWEST, _HIGHEST = -(2**63), 2**64 - 1  # whole numbers of MessagePack
_REPLACEMENT = "\N{REPLACEMENT CHARACTER}"


def encodable(value: Any) -> Any:  # noqa: ANN401 (whatever a message holds)
    """A value as it can be encoded: itself, or else a copy with what cannot be replaced.

    Text loses lone surrogates, of which file names and JSON may hold some; whole numbers are
    clipped to 64 bits.

    Args:
        value: of text, numbers, lists and dictionaries; other objects are taken as they are.
    """
    match value:
        case str():
            return value if value.isascii() else _text(value)
        case int() if not _LOWEST <= value <= _HIGHEST:
            return min(max(value, _LOWEST), _HIGHEST)
        case dict():
            return _same_or(value, {encodable(k): encodable(v) for k, v in value.items()})
        case list() | tuple():
            made = tuple if isinstance(value, tuple) else list
            return _same_or(value, made([encodable(one) for one in value]))
    return value


def _text(text: str) -> str:
    try:
        text.encode()
    except UnicodeEncodeError:
        return "".join(_REPLACEMENT if "\ud800" <= c <= "\udfff" else c for c in text)
    return text


def _same_or(before: Any, after: Any) -> Any:  # noqa: ANN401
    """What was there before, unless something in it has been replaced."""
    if isinstance(before, dict):
        pairs = zip(before.items(), after.items(), strict=False)
        same = len(before) == len(after) and all(a is c and b is d for (a, b), (c, d) in pairs)
    else:
        same = all(one is other for one, other in zip(before, after, strict=True))
    return before if same else after
